// BSDFs: all lobes and their mixtures, with shading normals, in both modes.
#include "shaders/lib/bsdf.glsl"

// Albedos that no surface has, but that rise with both coordinates: what is tested here must not depend on their values.
uvec4 fetchAlbedoTexel(uint index) {
    float a = 0.3 + 0.2 * fract(float(index) * 0.618034);
    return uvec4(packUnorm2x16(vec2(a, a + 0.05)), packUnorm2x16(vec2(a + 0.1, a + 0.15)),
                 packUnorm2x16(vec2(0.2, 0.25)), packUnorm2x16(vec2(0.3, 0.35)));
}

BsdfFrame frameWith(vec3 shading, vec3 geometric) {
    vec3 tangent, bitangent;
    orthonormalBasis(shading, tangent, bitangent);
    return BsdfFrame(shading, geometric, tangent, shading);
}

// Frames of a flat surface, and of one whose shading normal deviates by up to 40 degrees.
BsdfFrame flatFrame() {
    vec3 n = randomDirection();
    return frameWith(n, n);
}
BsdfFrame smoothFrame() {
    vec3 n = randomDirection();
    return frameWith(normalize(n + 0.6 * randomDirection()), n);
}

vec3 above(vec3 normal) {
    vec3 w = randomDirection();
    return dot(w, normal) < 0.0 ? -w : w;
}

vec3 onEitherSide() { return randomDirection(); }

Bsdf diffuseBsdf(vec3 albedo) {
    return Bsdf(albedo, 0.0, 0.5, vec3(0.0), 0.0, 0.0, 1.5, kBsdfOutside, 0.0, 0.0, vec3(0.0), 0.0, vec2(0.25), vec3(0.0), vec3(0.0), vec3(0.0));
}

// Any mixture of base lobes, without layers on it.
Bsdf randomBase() {
    float roughness = randomFloat(0.1, 1.0);
    float metallic = testIndex() % 3u == 0u ? 0.0 : (testIndex() % 3u == 1u ? 1.0 : randomFloat(0.0, 1.0));
    float transmission = testIndex() % 5u < 3u ? 0.0 : (testIndex() % 5u == 3u ? 1.0 : randomFloat(0.0, 1.0));
    float ior = randomFloat(1.05, 2.5);
    uint flags = (testIndex() % 7u < 2u ? kBsdfThin : 0u) | (testIndex() % 2u == 0u ? kBsdfOutside : 0u);
    float eta = (flags & kBsdfThin) != 0u || (flags & kBsdfOutside) != 0u ? ior : 1.0 / ior;
    float specular = testIndex() % 4u == 0u ? 0.0 : randomFloat(0.0, 1.0);
    vec2 alpha = vec2(randomFloat(roughness * roughness, 1.0), roughness * roughness);
    return Bsdf(randomVec3(0.0, 1.0), metallic, roughness, randomVec3(0.0, 0.3) * specular, specular, transmission, eta,
                flags, 0.0, 0.0, vec3(0.0), 0.0, alpha, vec3(0.0), vec3(0.0), vec3(0.0));
}
Bsdf randomBsdf() {
    Bsdf bsdf = randomBase();
    if (testIndex() % 11u > 6u) {
        bsdf.clearcoat = randomFloat(0.0, 1.0);
        bsdf.clearcoatRoughness = randomFloat(0.1, 1.0);
    }
    if (testIndex() % 11u < 3u) {
        bsdf.sheenColor = randomVec3(0.0, 1.0);
        bsdf.sheenRoughness = randomFloat(0.1, 1.0);
    }
    return bsdf;
}

// What light that arrives from the other side meets.
Bsdf fromOtherSide(Bsdf bsdf) {
    if (!isThin(bsdf)) bsdf.eta = 1.0 / bsdf.eta;
    bsdf.flags ^= kBsdfOutside;
    return bsdf;
}
BsdfFrame fromOtherSide(BsdfFrame frame) { return BsdfFrame(-frame.shading, -frame.geometric, frame.tangent, -frame.coat); }

uint randomMode() { return randomUint() & 1u; }

// Helmholtz: f(wo, wi) = f(wi, wo) on one side, and n_i^2 f(wo, wi) = n_o^2 f(wi, wo) through glass, whose other side
// sees the inverse index of refraction (Veach 1997, eq. 5.14).
TEST(IsReciprocal) {
    Bsdf bsdf = randomBase();
    BsdfFrame frame = flatFrame();
    vec3 wo = above(frame.geometric);
    vec3 wi = onEitherSide();
    vec3 f = bsdfEvaluate(bsdf, frame, wo, wi, kModeRadiance);
    bool through = dot(wi, frame.geometric) < 0.0;
    Bsdf other = through ? fromOtherSide(bsdf) : bsdf;
    BsdfFrame otherFrame = through ? fromOtherSide(frame) : frame;
    float ratio = through && !isThin(bsdf) ? bsdf.eta * bsdf.eta : 1.0;
    vec3 back = bsdfEvaluate(other, otherFrame, wi, wo, kModeRadiance);
    EXPECT_NEAR(f * ratio, back, 1e-3 * maxComponent(f * ratio) + 1e-6);
}

// Importance mode is the adjoint: the same function with the view and light directions exchanged.
TEST(BothModesEvaluateOneFunction) {
    Bsdf bsdf = randomBsdf();
    BsdfFrame frame = smoothFrame();
    vec3 view = above(frame.geometric);
    vec3 light = onEitherSide();
    bool through = dot(light, frame.geometric) < 0.0;
    Bsdf other = through ? fromOtherSide(bsdf) : bsdf;
    BsdfFrame otherFrame = through ? fromOtherSide(frame) : frame;
    // The light's side of the shading normal decides whether it is there at all.
    vec3 f = bsdfEvaluate(bsdf, frame, view, light, kModeRadiance);
    vec3 adjoint = bsdfEvaluate(other, otherFrame, light, view, kModeImportance);
    EXPECT_NEAR(f, adjoint, 1e-3 * maxComponent(f) + 1e-6);
}

// Lambert's law: a perfectly diffuse surface of albedo rho has f = rho / pi, in each channel separately.
TEST(DiffuseIsLamberts) {
    Bsdf bsdf = diffuseBsdf(randomVec3(0.0, 1.0));
    BsdfFrame frame = flatFrame();
    vec3 f = bsdfEvaluate(bsdf, frame, above(frame.geometric), above(frame.geometric), randomMode());
    EXPECT_ULP(f, bsdf.baseColor / 3.14159265, 4.0);
}

TEST(NothingIsBelowTheHorizon) {
    Bsdf bsdf = randomBsdf();
    bsdf.transmission = 0.0;
    BsdfFrame frame = smoothFrame();
    vec3 wo = above(frame.geometric);
    vec3 below = -above(frame.geometric);
    uint mode = randomMode();
    EXPECT_EQ(bsdfEvaluate(bsdf, frame, wo, below, mode), vec3(0.0));
    BsdfFrame level = frameWith(frame.geometric, frame.geometric);
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
    Bsdf bsdf = diffuseBsdf(vec3(0.5));
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
    vec3 wi = onEitherSide();
    uint mode = randomMode();
    vec3 f = bsdfEvaluate(bsdf, frame, wo, wi, mode);
    EXPECT_TRUE(maxComponent(f) == 0.0 || bsdfPdf(bsdf, frame, wo, wi, mode) > 0.0);
}

Bsdf mirror() {
    Bsdf bsdf = diffuseBsdf(vec3(0.25, 0.5, 1.0));
    bsdf.metallic = 1.0;
    bsdf.roughness = 0.0;
    bsdf.alpha = vec2(0.0);
    return bsdf;
}

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

// The same of a mirror under a rough varnish or sheen.
TEST(DensityIsPositiveWhereLayersOnAMirrorScatter) {
    Bsdf bsdf = mirror();
    bool coated = testIndex() % 2u == 0u;
    bsdf.clearcoat = coated ? 1.0 : 0.0;
    bsdf.clearcoatRoughness = randomFloat(0.2, 1.0);
    bsdf.sheenColor = vec3(coated ? 0.0 : 0.5);
    bsdf.sheenRoughness = randomFloat(0.2, 1.0);
    BsdfFrame frame = smoothFrame();
    vec3 wo = above(frame.geometric);
    vec3 wi = above(frame.geometric);
    uint mode = randomMode();
    vec3 f = bsdfEvaluate(bsdf, frame, wo, wi, mode);
    EXPECT_TRUE(maxComponent(f) == 0.0 || bsdfPdf(bsdf, frame, wo, wi, mode) > 0.0);
}

// The largest number that may choose a lobe, where rounding may leave no other than one that scatters nothing.
TEST(LargestChoiceMakesNoInfiniteWeight) {
    Bsdf bsdf = diffuseBsdf(randomVec3(0.0, 1.0));
    bsdf.alpha = vec2(0.0);
    bsdf.roughness = 0.0;
    bsdf.specular = testIndex() % 2u == 0u ? 0.0 : 1e-7;
    bsdf.sheenColor = vec3(testIndex() % 3u == 0u ? 0.3 : 0.0);
    bsdf.sheenRoughness = 0.5;
    BsdfFrame frame = flatFrame();
    BsdfSample s = bsdfSample(bsdf, frame, above(frame.geometric), 0.99999994, randomVec2(), randomMode());
    EXPECT_TRUE(!isnan(s.weight.x) && s.weight.x < 10.0);
}

// Colours above 1 are scattered several times like white.
TEST(SeveralScatteringsReturnAtMostAll) {
    vec3 f0 = randomVec3(0.0, 30.0);
    vec3 several = severalAlbedo(f0, 1.0, randomFloat(0.0, 0.99));
    EXPECT_GE(several, vec3(0.0));
    EXPECT_LE(several, vec3(1.0 + 1e-5));
}

Bsdf smoothGlass(float eta) {
    Bsdf bsdf = mirror();
    bsdf.baseColor = vec3(0.5);
    bsdf.metallic = 0.0;
    bsdf.transmission = 1.0;
    bsdf.eta = eta;
    bsdf.flags = eta > 1.0 ? kBsdfOutside : 0u;
    return bsdf;
}

// Snell's law: the sines are as the indices of refraction, in one plane; nothing beyond the critical angle. The choice
// of the lobe is by Fresnel's reflectance, so that only the base colour and, for radiance, the square of the index of
// refraction remain in the weight.
TEST(GlassRefractsByTheLawOfSnell) {
    float ior = randomFloat(1.1, 2.5);
    float eta = testIndex() % 2u == 0u ? ior : 1.0 / ior;
    BsdfFrame frame = flatFrame();
    vec3 wo = above(frame.geometric);
    uint mode = randomMode();
    BsdfSample s = bsdfSample(smoothGlass(eta), frame, wo, randomFloat(0.0, 1.0), randomVec2(), mode);
    EXPECT_EQ(s.pdf, kDeltaPdf);
    vec3 across = wo - dot(wo, frame.geometric) * frame.geometric;
    if (dot(s.wi, frame.geometric) < 0.0) {
        vec3 beyond = s.wi - dot(s.wi, frame.geometric) * frame.geometric;
        EXPECT_NEAR(beyond * eta, -across, 2e-3);
        EXPECT_NEAR(s.weight, vec3(mode == kModeRadiance ? 0.5 / (eta * eta) : 0.5), 1e-3);
        EXPECT_LE(length(across), eta + 1e-3);
    } else {
        EXPECT_NEAR(s.weight, vec3(1.0), 1e-3);
    }
}

// A thin wall lets light pass unbent.
TEST(ThinGlassDoesNotBendLight) {
    Bsdf bsdf = smoothGlass(1.5);
    bsdf.flags |= kBsdfThin;
    BsdfFrame frame = flatFrame();
    vec3 wo = above(frame.geometric);
    BsdfSample s = bsdfSample(bsdf, frame, wo, 0.0, randomVec2(), randomMode());
    if (dot(wo, frame.geometric) > 0.2) {
        EXPECT_NEAR(s.wi, -wo, 1e-4);
        EXPECT_NEAR(s.weight, vec3(0.5), 1e-4);
    }
}

// Half diffuse, half mirror: both lobes are sampled, and the weights compensate for the choice.
TEST(MirrorAndDiffuseShareTheirChoice) {
    Bsdf bsdf = mirror();
    bsdf.baseColor = vec3(1.0);
    bsdf.metallic = 0.5;
    BsdfFrame frame = flatFrame();
    vec3 wo = above(frame.geometric);
    BsdfSample s = bsdfSample(bsdf, frame, wo, randomFloat(0.0, 1.0), randomVec2(), kModeRadiance);
    // The made-up albedo of the mirror is between 0.3 and 1.
    EXPECT_GE(s.weight, vec3(0.6));
    EXPECT_LE(s.weight, vec3(1.7));
}

// Both layers take from a black surface only what they reflect themselves.
TEST(LayersLieOnTheBase) {
    Bsdf bsdf = diffuseBsdf(vec3(1.0));
    BsdfFrame frame = flatFrame();
    vec3 wo = above(frame.geometric);
    vec3 wi = above(frame.geometric);
    vec3 bare = bsdfEvaluate(bsdf, frame, wo, wi, kModeRadiance);
    bsdf.clearcoat = 1.0;
    bsdf.clearcoatRoughness = 0.0;
    // A smooth clearcoat only takes away, by Fresnel's reflectance towards the view, and only from outside.
    float reflected = 0.04 + 0.96 * pow(1.0 - max(dot(wo, frame.geometric), 1e-3), 5.0);
    EXPECT_NEAR(bsdfEvaluate(bsdf, frame, wo, wi, kModeRadiance), bare * (1.0 - reflected), 1e-4);
    bsdf.flags = 0u;
    EXPECT_EQ(bsdfEvaluate(bsdf, frame, wo, wi, kModeRadiance), bare);
}

TEST(AlbedoConservesEnergy) {
    Bsdf bsdf = randomBsdf();
    BsdfFrame frame = smoothFrame();
    vec3 wo = above(frame.geometric);
    EXPECT_LE(bsdfAlbedo(bsdf, frame, wo), vec3(1.0));
    EXPECT_GE(bsdfAlbedo(bsdf, frame, wo), vec3(0.0));
    Bsdf black = diffuseBsdf(vec3(0.0));
    EXPECT_EQ(bsdfAlbedo(black, frame, wo), vec3(0.0));
    EXPECT_EQ(bsdfSample(black, frame, wo, 0.5, randomVec2(), randomMode()).weight, vec3(0.0));
}
