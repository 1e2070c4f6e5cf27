#include <algorithm>

#include "tests/support/exact/receiver.h"

// Two panes are between the receiver and the luminaire; a ray from the receiver crosses the lower one first.
// By eq. 16 the radiance of the receiver is albedo / pi O T_lower T_upper E times Lambert's formula.
// Commuting matrices T test whether transmittance is applied at all; others test whether it is multiplied in
// order on segments whose traversal may find surfaces in any order. Shortcuts that skip a shadow ray if no
// surface can block light (`local`), or end it at the first hit (T = 0), must consider every material, not
// only the scene's reflectance.

namespace duolux::test {

namespace {

const Emission kPanelGlow{{3.0f, 2.0f, 5.0f}, {0.5f, 1.0f, 4.0f}, Sides::kFront};
const glm::vec3 kBesidePanes{0.95f, 0.2f, 0.25f};  // passes beside the panes

const ReflectanceMatrix kAmber{
    {0.9f, 0.1f, 0.5f}, {0.2f, 0.6f, 0.3f}, {0.1f, 0.8f, 0.4f}, {0.3f, 0.2f, 0.7f}};
const ReflectanceMatrix kTeal{{0.2f, 0.7f, 0.1f}, {0.8f, 0.1f, 0.5f}, {0.5f, 0.3f, 0.9f}, {0.6f, 0.4f, 0.2f}};
const ReflectanceMatrix kOpaque{
    {0.5f, 0.2f, 0.7f}, {0.4f, 0.6f, 0.1f}, {0.3f, 0.9f, 0.5f}, {0.2f, 0.3f, 0.4f}};

ReflectanceMatrix passes(float t) {
    return blendReflectance(t, 0.0f).transparent;
}

struct Pane {
    ReflectanceMatrix transparent;
    float height;
    bool half = false;  ///< covers x >= 0 alone
    bool turned = false;
    Material material = filter("pane", {});
};

struct PaneSetup {
    Reflectance receiver = preset("local");
    Reflectance scene = preset("local");
    std::vector<Pane> panes;
};

void addPane(SceneBuilder& builder, const Pane& pane) {
    Material material = pane.material;
    if (material.reflectance) material.reflectance->transparent = pane.transparent;
    const double x0 = pane.half ? 0.0 : -1.1;
    const auto c = downwardRectangle(x0, 1.1, -0.9, 0.9, static_cast<double>(pane.height));
    const std::uint32_t index = builder.add(material);
    if (pane.turned) {
        builder.quad(c[3], c[2], c[1], c[0], index);
    } else {
        builder.quad(c[0], c[1], c[2], c[3], index);
    }
}

ExactCase blocked(std::string name, const PaneSetup& setup) {
    ReceiverScene::Receiver receiver;
    receiver.reflectance = setup.receiver;
    ReceiverScene scene(receiver, kBesidePanes);
    scene.builder().scene.reflectance = setup.scene;
    // In two parts at the plane x = 0, where the edge of a half pane lies as seen from the origin.
    const std::vector<Vec3> left = downwardRectangle(-0.8, 0.0, -0.5, 0.9, 2),
                            whole = downwardRectangle(-0.8, 0.6, -0.5, 0.9, 2);
    const double leftFactor = lambertPolygon(Vec3(0.0), Vec3(0, 1, 0), left);
    const double rightFactor = lambertPolygon(Vec3(0.0), Vec3(0, 1, 0), whole) - leftFactor;
    scene.emitter(whole, kPanelGlow, preset("local"));
    ChannelMatrix throughLeft = reference::identityPerChannel(), throughRight = throughLeft;
    for (const Pane& pane : setup.panes) {
        addPane(scene.builder(), pane);
        const ChannelMatrix t = reference::channelsOf(pane.transparent);
        if (!pane.half) throughLeft = throughLeft * t;
        throughRight = throughRight * t;
    }
    const ChannelLight light = lightOf(kPanelGlow);
    return scene.finish(
        std::move(name), 1,
        scene.reflected(leftFactor * (throughLeft * light) + rightFactor * (throughRight * light)));
}

}  // namespace

ExactCase stackedPanesCase(int count) {
    PaneSetup setup{{kOpaque, {}}, preset("global"), {}};
    for (int i = 0; i < count; ++i) {
        const float height = 0.7f + 1.2f * static_cast<float>(i) / static_cast<float>(count);
        setup.panes.push_back({matrix(0.98f, 0.01f, 0.02f, 0.97f), height});
    }
    return blocked("BlockerStack" + std::to_string(count), setup);
}

std::vector<ExactCase> blockerCases() {
    std::vector<ExactCase> cases;
    const auto add = [&](const char* name, const PaneSetup& setup) { cases.push_back(blocked(name, setup)); };
    const Reflectance mixing{kOpaque, {}};

    // A pane of the scene's own reflectance: absent in `local`, t each in blend (t, 0).
    Material plain;
    plain.name = "plain";
    add("BlockerAbsentInLocal",
        {preset("local"), preset("local"), {{passes(1.0f), 0.7f, false, false, plain}}});
    const Reflectance blend = blendReflectance(0.5f, 0.0f);
    add("BlockerBlend", {blend, blend, {{passes(0.5f), 0.7f, false, false, plain}}});
    add("BlockerBlendTwice",
        {blend,
         blend,
         {{passes(0.5f), 0.7f, false, false, plain}, {passes(0.5f), 1.3f, false, true, plain}}});
    Material oneSided = plain;
    oneSided.sides = Sides::kFront;
    add("BlockerFrontOnlyPassesBothWays",
        {blend,
         blend,
         {{passes(0.5f), 0.7f, false, false, oneSided}, {passes(0.5f), 1.3f, false, true, oneSided}}});

    // One opaque object in a scene that is `local` otherwise still casts its shadow, whole or half.
    add("BlockerOpaqueInLocal", {preset("local"), preset("local"), {{passes(0.0f), 1.3f}}});
    add("BlockerOpaqueHalfInLocal", {preset("local"), preset("local"), {{passes(0.0f), 1.3f, true}}});
    add("BlockerClearInGlobal", {preset("global"), preset("global"), {{passes(1.0f), 0.7f}}});

    add("BlockerDiagonal", {mixing, preset("global"), {{matrix(0.5f, 0, 0, 0.25f), 0.7f}}});
    add("BlockerFull", {mixing, preset("global"), {{kAmber, 0.7f}}});
    add("BlockerAmberTeal", {mixing, preset("global"), {{kAmber, 0.7f}, {kTeal, 1.3f}}});
    add("BlockerTealAmber", {mixing, preset("global"), {{kTeal, 0.7f}, {kAmber, 1.3f}}});
    add("BlockerTealAmberTeal", {mixing, preset("global"), {{kTeal, 0.5f}, {kAmber, 0.7f}, {kTeal, 1.6f}}});
    add("BlockerHalfAmberTeal", {mixing, preset("global"), {{kAmber, 0.7f}, {kTeal, 1.3f, true}}});
    // Panes listed from the top: the order of the triangles must not matter.
    PaneSetup shuffled{mixing, preset("global"), {{kAmber, 0.7f}, {kTeal, 1.3f}}};
    ExactCase reversed = blocked("BlockerListedFromTop", shuffled);
    std::reverse(reversed.scene.geometry.triangles.begin(), reversed.scene.geometry.triangles.end());
    std::reverse(reversed.scene.geometry.materials.begin(), reversed.scene.geometry.materials.end());
    cases.push_back(std::move(reversed));
    // Two panes at the same place are two panes, and nothing limits their number.
    add("BlockerCoincident", {mixing, preset("global"), {{kAmber, 0.7f}, {kAmber, 0.7f}}});
    cases.push_back(stackedPanesCase(24));
    // Strictly triangular matrices T: their product is zero in this order, and non-zero in the other.
    const ReflectanceMatrix raise = matrix(0, 1, 0, 0), lower = matrix(1, 0, 0, 0);
    add("BlockerExtinct", {mixing, preset("global"), {{raise, 0.7f}, {lower, 1.3f}}});
    add("BlockerNotExtinct", {mixing, preset("global"), {{lower, 0.7f}, {raise, 1.3f}}});
    return cases;
}

}  // namespace duolux::test
