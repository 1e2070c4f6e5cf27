#include "host/device_scene/device_camera.h"

#include "host/scene/image_plane.h"

namespace duolux {

shared::DeviceCamera deviceCamera(const Camera& camera, std::uint32_t width, std::uint32_t height,
                                  const Bounds& bounds) {
    const ImagePlane plane = imagePlane(camera, width, height);
    const RayStart start = rayStart(camera, bounds);
    return {camera.position, width,    plane.forward, height,        plane.right,
            plane.area,      plane.up, start.depth,   start.position};
}

std::uint32_t deviceKind(CameraType type) {
    switch (type) {
        case CameraType::kPerspective:
            return shared::kCameraPerspective;
        case CameraType::kOrthographic:
            return shared::kCameraOrthographic;
    }
    return shared::kCameraPerspective;
}

}  // namespace duolux
