#include "tests/support/closed_form.h"
#include "tests/support/exact_case.h"
#include "tests/support/scene_builder.h"

// Concentric closed spheres: every ray crosses the same surfaces in the same order, so the radiance is a
// fixed expression in the matrices T and the emissions E. Matrices T that do not commute detect products in
// the wrong order, on camera rays (bounces = 0, no noise at all) and on shadow rays (bounces > 0). Also
// detects emission from the wrong side, crossings missed or counted twice, and mixed-up channels.

namespace duolux::test {

namespace {

const ReflectanceMatrix kFirst{
    {0.9f, 0.1f, 0.5f}, {0.2f, 0.6f, 0.3f}, {0.1f, 0.8f, 0.4f}, {0.3f, 0.2f, 0.7f}};
const ReflectanceMatrix kSecond{
    {0.2f, 0.7f, 0.1f}, {0.8f, 0.1f, 0.5f}, {0.5f, 0.3f, 0.9f}, {0.6f, 0.4f, 0.2f}};
const ReflectanceMatrix kThird{
    {0.0f, 0.5f, 1.0f}, {1.0f, 0.2f, 0.0f}, {0.5f, 0.0f, 0.3f}, {0.0f, 1.0f, 0.6f}};

Material pane(const char* name, const ReflectanceMatrix& transparent, const Emission& emission) {
    Material material = filter(name, transparent);
    material.emission = emission;
    return material;
}

const Emission kShellGlow[] = {{{1.0f, 2.0f, 3.0f}, {0.5f, 0.25f, 0.75f}, Sides::kFront},
                               {{0.2f, 0.4f, 0.1f}, {4.0f, 1.0f, 2.0f}, Sides::kFront},
                               {{5.0f, 3.0f, 0.0f}, {0.0f, 7.0f, 6.0f}, Sides::kFront}};

LoadedScene view(SceneBuilder builder, glm::vec3 position, float vfov, std::uint32_t bounces) {
    LoadedScene& scene = builder.scene;
    scene.reflectance = preset("global");
    scene.camera = {position, position + glm::vec3(0.0f, 0.0f, -1.0f), {0, 1, 0}, vfov};
    scene.settings.width = scene.settings.height = 16;
    scene.settings.bounces = bounces;
    return scene;
}

/// Two spheres seen from outside. They face inwards, so a ray first crosses the back of each, which is dark,
/// then its front.
ExactCase fromOutside(const char* name, const ReflectanceMatrix& outer, const ReflectanceMatrix& inner,
                      Sides sides) {
    SceneBuilder builder;
    Emission a = kShellGlow[0], b = kShellGlow[1];
    a.sides = b.sides = sides;
    builder.sphere(glm::vec3(0.0f), 1.0f, 1, Facing::kInward, builder.add(pane("inner", inner, b)));
    builder.sphere(glm::vec3(0.0f), 2.0f, 1, Facing::kInward, builder.add(pane("outer", outer, a)));
    const ChannelMatrix ta = reference::channelsOf(outer), tb = reference::channelsOf(inner);
    const ChannelLight ea = lightOf(a), eb = lightOf(b);
    const ChannelLight beyond = eb + tb * ea;
    const ChannelLight expected = sides == Sides::kFront ? ta * (tb * beyond) : ea + ta * (eb + tb * beyond);
    return {name, view(builder, {0, 0, 8}, 6.0f, 0), uniformImage(16, 16, expected)};
}

/// Three spheres from their centre: E1 + T1 (E2 + T2 E3), to which the innermost adds its interreflections.
ExactCase fromCentre(const char* name, const ReflectanceMatrix& first, const ReflectanceMatrix& second,
                     std::uint32_t bounces) {
    const glm::vec3 albedo{0.4f, 0.6f, 0.8f};
    const ReflectanceMatrix opaque{
        {0.3f, 0.5f, 0.2f}, {0.5f, 0.1f, 0.4f}, {0.7f, 0.2f, 0.6f}, {0.1f, 0.4f, 0.3f}};
    SceneBuilder builder;
    Material inner = pane("inner", first, kShellGlow[0]);
    inner.baseColor = albedo;
    inner.sides = Sides::kFront;
    inner.reflectance->opaque = opaque;
    builder.sphere(glm::vec3(0.0f), 1.0f, 1, Facing::kInward, builder.add(inner));
    builder.sphere(glm::vec3(0.0f), 1.5f, 1, Facing::kInward,
                   builder.add(pane("middle", second, kShellGlow[1])));
    builder.sphere(glm::vec3(0.0f), 2.5f, 1, Facing::kInward,
                   builder.add(pane("outer", kThird, kShellGlow[2])));
    const ChannelMatrix t1 = reference::channelsOf(first), t2 = reference::channelsOf(second);
    const ChannelLight source =
        lightOf(kShellGlow[0]) + t1 * (lightOf(kShellGlow[1]) + t2 * lightOf(kShellGlow[2]));
    const ChannelMatrix scatter = scaled(albedo, reference::channelsOf(opaque));
    return {name, view(builder, glm::vec3(0.1f), 70.0f, bounces),
            uniformImage(16, 16, enclosureRadiance(scatter, source, bounces))};
}

}  // namespace

std::vector<ExactCase> crossingCases() {
    return {
        fromOutside("CrossingOutsideAB", kFirst, kSecond, Sides::kFront),
        fromOutside("CrossingOutsideBA", kSecond, kFirst, Sides::kFront),
        fromOutside("CrossingOutsideBothSidesAB", kFirst, kSecond, Sides::kBoth),
        fromOutside("CrossingOutsideBothSidesBA", kSecond, kFirst, Sides::kBoth),
        // A nilpotent T: light that crosses it twice vanishes.
        fromOutside("CrossingNilpotent", kFirst, matrix(0.0f, 1.0f, 0.0f, 0.0f), Sides::kBoth),
        // The camera sees through these, and invisible light passes as in `local`: it needs no second column.
        fromOutside("CrossingSeeThrough", matrix(1.0f, 0.0f, 1.0f, 0.0f), matrix(1.0f, 0.0f, 1.0f, 0.0f),
                    Sides::kBoth),
        fromCentre("CrossingCentre", kFirst, kSecond, 0), fromCentre("CrossingCentreAB1", kFirst, kSecond, 1),
        fromCentre("CrossingCentreBA1", kSecond, kFirst, 1),
        fromCentre("CrossingCentreAB12", kFirst, kSecond, 12)};
}

}  // namespace duolux::test
