#include "tests/support/cornell.h"

#include "tests/support/scene_builder.h"

namespace duolux::test {

namespace {

void addMaterials(SceneBuilder& builder) {
    const auto add = [&](const char* name, glm::vec3 diffuse) {
        Material material;
        material.name = name;
        material.baseColor = diffuse;
        builder.add(material);
    };
    add("white", {0.74f, 0.72f, 0.68f});
    add("red", {0.62f, 0.06f, 0.05f});
    add("green", {0.12f, 0.44f, 0.10f});
    add("light", {0.78f, 0.78f, 0.78f});
    add("short", {0.74f, 0.72f, 0.68f});
    add("tall", {0.74f, 0.72f, 0.68f});
    // The paper's eq. 10: a luminaire that the camera does not see.
    builder.scene.materials[kLight].emission = {{18.0f, 13.0f, 6.5f}, glm::vec3(0.0f), Sides::kFront};
}

void addRoom(SceneBuilder& b) {
    b.quad({552.8f, 0, 0}, {0, 0, 0}, {0, 0, 559.2f}, {549.6f, 0, 559.2f}, kWhite);
    b.quad({556, 548.8f, 0}, {556, 548.8f, 559.2f}, {0, 548.8f, 559.2f}, {0, 548.8f, 0}, kWhite);
    b.quad({549.6f, 0, 559.2f}, {0, 0, 559.2f}, {0, 548.8f, 559.2f}, {556, 548.8f, 559.2f}, kWhite);
    b.quad({0, 0, 559.2f}, {0, 0, 0}, {0, 548.8f, 0}, {0, 548.8f, 559.2f}, kGreen);
    b.quad({552.8f, 0, 0}, {549.6f, 0, 559.2f}, {556, 548.8f, 559.2f}, {556, 548.8f, 0}, kRed);
    // Slightly below the ceiling, so that the two are hit in a definite order.
    b.quad({343, 548.3f, 227}, {343, 548.3f, 332}, {213, 548.3f, 332}, {213, 548.3f, 227}, kLight);
}

void addBlocks(SceneBuilder& b) {
    b.quad({130, 165, 65}, {82, 165, 225}, {240, 165, 272}, {290, 165, 114}, kShort);
    b.quad({290, 0, 114}, {290, 165, 114}, {240, 165, 272}, {240, 0, 272}, kShort);
    b.quad({130, 0, 65}, {130, 165, 65}, {290, 165, 114}, {290, 0, 114}, kShort);
    b.quad({82, 0, 225}, {82, 165, 225}, {130, 165, 65}, {130, 0, 65}, kShort);
    b.quad({240, 0, 272}, {240, 165, 272}, {82, 165, 225}, {82, 0, 225}, kShort);

    b.quad({423, 330, 247}, {265, 330, 296}, {314, 330, 456}, {472, 330, 406}, kTall);
    b.quad({423, 0, 247}, {423, 330, 247}, {472, 330, 406}, {472, 0, 406}, kTall);
    b.quad({472, 0, 406}, {472, 330, 406}, {314, 330, 456}, {314, 0, 456}, kTall);
    b.quad({314, 0, 456}, {314, 330, 456}, {265, 330, 296}, {265, 0, 296}, kTall);
    b.quad({265, 0, 296}, {265, 330, 296}, {423, 330, 247}, {423, 0, 247}, kTall);
}

Material lampMaterial() {
    Material lamp;
    lamp.name = "lamp";
    lamp.baseColor = glm::vec3(0.4f);
    lamp.emission = {{6.0f, 2.0f, 9.0f}, {1.0f, 5.0f, 3.0f}, Sides::kBoth};
    return lamp;
}

void addLamp(SceneBuilder& builder, const Material& lamp) {
    builder.quad({120, 300, 180}, {200, 340, 160}, {190, 420, 220}, {110, 380, 240}, builder.add(lamp));
}

SceneBuilder room() {
    SceneBuilder builder;
    addMaterials(builder);
    addRoom(builder);
    builder.scene.camera = {{278, 273, -800}, {278, 273, 0}, {0, 1, 0}, 39.3f};
    builder.scene.reflectance = preset("global");
    builder.scene.settings.width = builder.scene.settings.height = 32;
    return builder;
}

}  // namespace

LoadedScene cornellBox() {
    SceneBuilder builder = room();
    addBlocks(builder);
    return builder.scene;
}

LoadedScene emptyCornellBox() {
    SceneBuilder builder = room();
    builder.scene.materials[kLight].emission.visible = builder.scene.materials[kLight].emission.invisible;
    return builder.scene;
}

LoadedScene mixedCornellBox() {
    SceneBuilder builder = room();
    addBlocks(builder);
    LoadedScene& scene = builder.scene;
    scene.reflectance = blendReflectance(0.25f, 0.75f);
    scene.materials[kTall].reflectance = preset("shadowless");
    scene.materials[kShort].reflectance = preset("global");
    scene.materials[kRed].reflectance =
        Reflectance{{{0.6f, 0.5f, 0.4f}, {0.2f, 0.1f, 0.3f}, {0.9f, 0.7f, 0.8f}, {0.3f, 0.4f, 0.1f}},
                    {{0.3f, 0.1f, 0.2f}, {0.1f, 0.3f, 0.2f}, {0.2f, 0.4f, 0.1f}, {0.4f, 0.2f, 0.3f}}};
    scene.materials[kGreen].reflectance = blendReflectance(0.5f, 0.5f);
    scene.materials[kGreen].sides = Sides::kFront;

    Material lamp = lampMaterial();
    lamp.reflectance = Reflectance{matrix(0.5f, 0.25f, 0.75f, 0.25f), matrix(0.25f, 0.0f, 0.5f, 0.125f)};
    addLamp(builder, lamp);
    return builder.scene;
}

LoadedScene lampsCornellBox() {
    SceneBuilder builder = room();
    addBlocks(builder);
    addLamp(builder, lampMaterial());
    Material glow;
    glow.name = "glow";
    glow.emission.visible = {0.5f, 1.0f, 2.0f};
    builder.quad({130, 170, 65}, {82, 170, 225}, {240, 170, 272}, {290, 170, 114}, builder.add(glow));
    return builder.scene;
}

}  // namespace duolux::test
