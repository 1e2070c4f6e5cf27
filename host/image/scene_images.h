#pragma once

#include "host/loaders/tally.h"
#include "host/scene/scene.h"

namespace duolux {

/// Decodes LoadedScene::imageSources into Scene::images, in parallel, and lists their files among those that
/// were read. An image that is missing or damaged is reported in the scene's warnings, and materials lose the
/// textures that use it; `reading` kStrict: throws InputError instead. Textures of images that are linear
/// whatever their use become linear.
void decodeImages(LoadedScene& scene, Reading reading);

}  // namespace duolux
