// Ordinary BSDFs, in the shading frame.
#include "shaders/lib/bsdf.glsl"

vec3 above(vec3 w) { return vec3(w.xy, abs(w.z)); }

Bsdf randomBsdf() { return Bsdf(randomVec3(0.0, 1.0)); }

// Helmholtz: f(wo, wi) = f(wi, wo).
TEST(IsReciprocal) {
    Bsdf bsdf = randomBsdf();
    vec3 wo = above(randomDirection());
    vec3 wi = above(randomDirection());
    EXPECT_EQ(bsdfEvaluate(bsdf, wo, wi), bsdfEvaluate(bsdf, wi, wo));
}

// Lambert's law: a perfectly diffuse surface of albedo rho has f = rho / pi, in each channel by itself.
TEST(DiffuseIsLamberts) {
    Bsdf bsdf = randomBsdf();
    vec3 f = bsdfEvaluate(bsdf, above(randomDirection()), above(randomDirection()));
    EXPECT_ULP(f, bsdf.diffuse / 3.14159265, 4.0);
}

TEST(NothingIsBelowTheHorizon) {
    Bsdf bsdf = randomBsdf();
    vec3 wo = above(randomDirection());
    vec3 below = -above(randomDirection());
    EXPECT_EQ(bsdfPdf(bsdf, wo, below), 0.0);
    EXPECT_GT(bsdfPdf(bsdf, wo, -below), 0.0);
    EXPECT_GE(bsdfSample(bsdf, wo, randomVec2()).wi.z, 0.0);
}

// The pdf and the weight of a sample agree with bsdfPdf and bsdfEvaluate for its direction.
TEST(SampleAgreesWithPdfAndEvaluation) {
    Bsdf bsdf = randomBsdf();
    vec3 wo = above(randomDirection());
    BsdfSample s = bsdfSample(bsdf, wo, randomVec2());
    EXPECT_ULP(s.pdf, bsdfPdf(bsdf, wo, s.wi), 4.0);
    EXPECT_ULP(s.weight * s.pdf, bsdfEvaluate(bsdf, wo, s.wi) * s.wi.z, 6.0);
}

// By Malley's method, so that the square's stratification is that of directions.
TEST(DiffuseSamplesAreMalleys) {
    vec2 u = randomVec2();
    BsdfSample s = bsdfSample(randomBsdf(), above(randomDirection()), u);
    EXPECT_NEAR(dot(s.wi.xy, s.wi.xy), u.x, 1.5e-6);
    EXPECT_EQ(s.wi, cosineHemisphere(u));
}

// At the ends of the square: straight up, and at the horizon with a density that is small but not zero.
TEST_N(SampleAgreesAtTheEnds, 4) {
    float last = 1.0 - 1.0 / 16777216.0;
    vec2 u = vec2((testIndex() & 1u) == 0u ? 0.0 : last, (testIndex() & 2u) == 0u ? 0.0 : last);
    Bsdf bsdf = Bsdf(vec3(0.25, 0.5, 1.0));
    BsdfSample s = bsdfSample(bsdf, vec3(0.0, 0.0, 1.0), u);
    EXPECT_GT(s.pdf, 0.0);
    EXPECT_ULP(s.pdf, bsdfPdf(bsdf, vec3(0.0, 0.0, 1.0), s.wi), 4.0);
    EXPECT_ULP(s.weight * s.pdf, bsdfEvaluate(bsdf, vec3(0.0, 0.0, 1.0), s.wi) * s.wi.z, 6.0);
}

TEST(AlbedoAndWeightConserveEnergy) {
    Bsdf bsdf = randomBsdf();
    vec3 wo = above(randomDirection());
    EXPECT_LE(bsdfAlbedo(bsdf, wo), vec3(1.0));
    EXPECT_GE(bsdfAlbedo(bsdf, wo), vec3(0.0));
    EXPECT_EQ(bsdfAlbedo(Bsdf(vec3(0.0)), wo), vec3(0.0));
    EXPECT_EQ(bsdfSample(Bsdf(vec3(0.0)), wo, randomVec2()).weight, vec3(0.0));
}
