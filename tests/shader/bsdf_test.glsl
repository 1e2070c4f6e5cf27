// BSDFs: both lobes and their mixtures, with shading normals, in both modes.
#include "shaders/lib/bsdf.glsl"

// Frames of a flat surface, and of one whose shading normal deviates by up to 40 degrees.
BsdfFrame flatFrame() {
    vec3 n = randomDirection();
    return BsdfFrame(n, n);
}
BsdfFrame smoothFrame() {
    vec3 n = randomDirection();
    return BsdfFrame(normalize(n + 0.6 * randomDirection()), n);
}

vec3 above(vec3 normal) {
    vec3 w = randomDirection();
    return dot(w, normal) < 0.0 ? -w : w;
}

// Diffuse, metallic, or a mixture.
Bsdf randomBsdf() {
    float metallic = testIndex() % 3u == 0u ? 0.0 : (testIndex() % 3u == 1u ? 1.0 : randomFloat(0.0, 1.0));
    return Bsdf(randomVec3(0.0, 1.0), metallic, randomFloat(0.1, 1.0));
}

uint randomMode() { return randomUint() & 1u; }

// Helmholtz: f(wo, wi) = f(wi, wo).
TEST(IsReciprocal) {
    Bsdf bsdf = randomBsdf();
    BsdfFrame frame = flatFrame();
    vec3 wo = above(frame.geometric);
    vec3 wi = above(frame.geometric);
    uint mode = randomMode();
    vec3 f = bsdfEvaluate(bsdf, frame, wo, wi, mode);
    EXPECT_NEAR(f, bsdfEvaluate(bsdf, frame, wi, wo, mode), 2e-4 * maxComponent(f));
}

// Importance mode is the adjoint: the same function with the view and light directions exchanged.
TEST(BothModesEvaluateOneFunction) {
    Bsdf bsdf = randomBsdf();
    BsdfFrame frame = smoothFrame();
    vec3 view = above(frame.geometric);
    vec3 light = above(frame.geometric);
    EXPECT_EQ(bsdfEvaluate(bsdf, frame, view, light, kModeRadiance),
              bsdfEvaluate(bsdf, frame, light, view, kModeImportance));
}

// Lambert's law: a perfectly diffuse surface of albedo rho has f = rho / pi, in each channel separately.
TEST(DiffuseIsLamberts) {
    Bsdf bsdf = Bsdf(randomVec3(0.0, 1.0), 0.0, randomFloat(0.0, 1.0));
    BsdfFrame frame = flatFrame();
    vec3 f = bsdfEvaluate(bsdf, frame, above(frame.geometric), above(frame.geometric), randomMode());
    EXPECT_ULP(f, bsdf.baseColor / 3.14159265, 4.0);
}

TEST(NothingIsBelowTheHorizon) {
    Bsdf bsdf = randomBsdf();
    BsdfFrame frame = smoothFrame();
    vec3 wo = above(frame.geometric);
    vec3 below = -above(frame.geometric);
    uint mode = randomMode();
    EXPECT_EQ(bsdfEvaluate(bsdf, frame, wo, below, mode), vec3(0.0));
    BsdfFrame level = BsdfFrame(frame.geometric, frame.geometric);
    EXPECT_EQ(bsdfPdf(bsdf, level, wo, below, mode), 0.0);
    BsdfSample s = bsdfSample(bsdf, frame, wo, randomFloat(0.0, 1.0), randomVec2(), mode);
    EXPECT_TRUE(s.pdf == 0.0 || dot(s.wi, frame.geometric) > 0.0);
    // Light from behind the shading normal is not reflected.
    vec3 light = above(frame.geometric);
    light -= 1.2 * max(dot(light, frame.shading), 0.0) * frame.shading;
    EXPECT_EQ(bsdfEvaluate(bsdf, frame, wo, normalize(light), kModeRadiance), vec3(0.0));
}

// The pdf and the weight of a sample agree with bsdfPdf and bsdfEvaluate for its direction.
TEST(SampleAgreesWithPdfAndEvaluation) {
    Bsdf bsdf = randomBsdf();
    BsdfFrame frame = smoothFrame();
    vec3 wo = above(frame.geometric);
    uint mode = randomMode();
    BsdfSample s = bsdfSample(bsdf, frame, wo, randomFloat(0.0, 1.0), randomVec2(), mode);
    float pdf = bsdfPdf(bsdf, frame, wo, s.wi, mode);
    vec3 value = bsdfEvaluate(bsdf, frame, wo, s.wi, mode) * bsdfCosine(frame, s.wi, mode);
    EXPECT_TRUE(s.pdf == 0.0 || abs(s.pdf - pdf) <= 1e-4 * pdf);
    EXPECT_NEAR(s.weight * pdf, value, 1e-4 * maxComponent(value) + 1e-7);
}

// Malley's method, about the shading normal from the camera and about the geometric normal from the emitters.
TEST(DiffuseSamplesAreMalleys) {
    Bsdf bsdf = Bsdf(vec3(0.5), 0.0, 0.5);
    BsdfFrame frame = smoothFrame();
    vec2 u = randomVec2();
    uint mode = randomMode();
    BsdfSample s = bsdfSample(bsdf, frame, above(frame.geometric), 0.5, u, mode);
    float cosine = dot(s.wi, mode == kModeRadiance ? frame.shading : frame.geometric);
    EXPECT_NEAR(cosine * cosine, 1.0 - u.x, 2e-6);
}

// Samples can reach every direction with f > 0: in importance mode also below the shading normal's horizon.
TEST(DensityIsPositiveWhereLightGoes) {
    Bsdf bsdf = randomBsdf();
    BsdfFrame frame = smoothFrame();
    vec3 wo = above(frame.geometric);
    vec3 wi = above(frame.geometric);
    uint mode = randomMode();
    vec3 f = bsdfEvaluate(bsdf, frame, wo, wi, mode);
    EXPECT_TRUE(maxComponent(f) == 0.0 || bsdfPdf(bsdf, frame, wo, wi, mode) > 0.0);
}

Bsdf mirror() { return Bsdf(vec3(0.25, 0.5, 1.0), 1.0, 0.0); }

// A mirror has one direction and Fresnel reflectance: the base colour at normal, 1 at grazing incidence.
TEST(MirrorReflects) {
    BsdfFrame frame = flatFrame();
    vec3 wo = above(frame.geometric);
    uint mode = randomMode();
    BsdfSample s = bsdfSample(mirror(), frame, wo, 0.999, randomVec2(), mode);
    float cosine = max(dot(wo, frame.geometric), 1e-3);
    EXPECT_NEAR(s.wi, 2.0 * dot(wo, frame.geometric) * frame.geometric - wo, 3e-3);
    EXPECT_EQ(s.pdf, kDeltaPdf);
    vec3 fresnel = mirror().baseColor + (1.0 - mirror().baseColor) * pow(1.0 - cosine, 5.0);
    EXPECT_NEAR(s.weight, fresnel, 1e-5);
    EXPECT_EQ(bsdfEvaluate(mirror(), frame, wo, s.wi, mode), vec3(0.0));
}

// Half diffuse, half mirror: both lobes are sampled, and the weights compensate for the choice.
TEST(MirrorAndDiffuseShareTheirChoice) {
    Bsdf bsdf = Bsdf(vec3(1.0), 0.5, 0.0);
    BsdfFrame frame = flatFrame();
    vec3 wo = above(frame.geometric);
    BsdfSample s = bsdfSample(bsdf, frame, wo, randomFloat(0.0, 1.0), randomVec2(), kModeRadiance);
    EXPECT_NEAR(s.weight, vec3(1.0), 2e-3);
}

TEST(AlbedoConservesEnergy) {
    Bsdf bsdf = randomBsdf();
    BsdfFrame frame = smoothFrame();
    vec3 wo = above(frame.geometric);
    EXPECT_LE(bsdfAlbedo(bsdf, frame, wo), vec3(1.0));
    EXPECT_GE(bsdfAlbedo(bsdf, frame, wo), vec3(0.0));
    Bsdf black = Bsdf(vec3(0.0), 0.0, 0.5);
    EXPECT_EQ(bsdfAlbedo(black, frame, wo), vec3(0.0));
    EXPECT_EQ(bsdfSample(black, frame, wo, 0.5, randomVec2(), randomMode()).weight, vec3(0.0));
}
