#include "host/device_scene/device_camera.h"

#include <algorithm>

#include "host/scene/image_plane.h"

namespace duolux {

namespace {

constexpr std::uint32_t kindOf(CameraType type) {
    switch (type) {
        case CameraType::kPerspective:
            return shared::kCameraPerspective;
        case CameraType::kOrthographic:
            return shared::kCameraOrthographic;
    }
    return shared::kCameraPerspective;
}
static_assert(std::ranges::all_of(kValuesOf<CameraType>,
                                  [](CameraType type) { return kindOf(type) < shared::kCameraKinds; }) &&
                  kValuesOf<CameraType>.size() == shared::kCameraKinds,
              "the shader tests go through kCameraKinds");

}  // namespace

shared::DeviceCamera deviceCamera(const Camera& camera, std::uint32_t width, std::uint32_t height,
                                  const Bounds& bounds) {
    const ImagePlane plane = imagePlane(camera, width, height);
    const RayStart start = rayStart(camera, bounds);
    return {camera.position, width,    plane.forward, height,        plane.right,
            plane.area,      plane.up, start.depth,   start.position};
}

std::uint32_t deviceKind(CameraType type) {
    return kindOf(type);
}

}  // namespace duolux
