#include "host/tools/peers/embree_scene.h"

#include <fmt/format.h>

#include <cstring>

#include "host/base/clock.h"
#include "host/base/error.h"
#include "host/base/parallel.h"

#ifdef DUOLUX_EMBREE4
#include <embree4/rtcore.h>
#else
#include <embree3/rtcore.h>
#endif

namespace duolux {

namespace {

RTCRay makeRay(const glm::vec3& origin, const glm::vec3& direction, float tMax) {
    RTCRay ray{};
    ray.org_x = origin.x, ray.org_y = origin.y, ray.org_z = origin.z;
    ray.dir_x = direction.x, ray.dir_y = direction.y, ray.dir_z = direction.z;
    ray.tfar = tMax;
    ray.mask = 0xffffffffu;
    return ray;
}

template <typename T>
void setBuffer(RTCGeometry geometry, RTCBufferType type, RTCFormat format, std::span<const T> items) {
    void* buffer = rtcSetNewGeometryBuffer(geometry, type, 0, format, sizeof(T), items.size());
    if (buffer == nullptr) throw MemoryError("Embree: out of memory");
    std::memcpy(buffer, items.data(), items.size_bytes());
}

}  // namespace

struct EmbreeScene::State {
    RTCDevice device = rtcNewDevice(nullptr);
    RTCScene scene = nullptr;
    double buildSeconds = 0.0;

    ~State() {
        if (scene != nullptr) rtcReleaseScene(scene);
        if (device != nullptr) rtcReleaseDevice(device);
    }
};

EmbreeScene::EmbreeScene(const Geometry& geometry) : state_(std::make_unique<State>()) {
    if (state_->device == nullptr) throw MachineError("Embree: no device");
    state_->scene = rtcNewScene(state_->device);
    rtcSetSceneBuildQuality(state_->scene, RTC_BUILD_QUALITY_MEDIUM);
    const RTCGeometry mesh = rtcNewGeometry(state_->device, RTC_GEOMETRY_TYPE_TRIANGLE);
    setBuffer<glm::vec3>(mesh, RTC_BUFFER_TYPE_VERTEX, RTC_FORMAT_FLOAT3, geometry.positions);
    setBuffer<glm::uvec3>(mesh, RTC_BUFFER_TYPE_INDEX, RTC_FORMAT_UINT3, geometry.triangles);
    rtcCommitGeometry(mesh);
    rtcAttachGeometry(state_->scene, mesh);
    rtcReleaseGeometry(mesh);
    const Clock::time_point start = Clock::now();
    rtcCommitScene(state_->scene);
    state_->buildSeconds = secondsSince(start);
    if (const RTCError error = rtcGetDeviceError(state_->device); error != RTC_ERROR_NONE) {
        throw MachineError(fmt::format("Embree: error {} while building", static_cast<int>(error)));
    }
}

EmbreeScene::~EmbreeScene() = default;

double EmbreeScene::buildSeconds() const {
    return state_->buildSeconds;
}

EmbreeScene::Hit EmbreeScene::nearest(const glm::vec3& origin, const glm::vec3& direction, float tMax) const {
    RTCRayHit query{};
    query.ray = makeRay(origin, direction, tMax);
    query.hit.geomID = RTC_INVALID_GEOMETRY_ID;
#ifdef DUOLUX_EMBREE4
    rtcIntersect1(state_->scene, &query, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcIntersect1(state_->scene, &context, &query);
#endif
    if (query.hit.geomID == RTC_INVALID_GEOMETRY_ID) return {};
    return {query.hit.primID, query.ray.tfar};
}

bool EmbreeScene::occluded(const glm::vec3& origin, const glm::vec3& direction, float tMax) const {
    RTCRay ray = makeRay(origin, direction, tMax);
#ifdef DUOLUX_EMBREE4
    rtcOccluded1(state_->scene, &ray, nullptr);
#else
    RTCIntersectContext context;
    rtcInitIntersectContext(&context);
    rtcOccluded1(state_->scene, &context, &ray);
#endif
    return ray.tfar < 0.0f;
}

void EmbreeScene::trace(std::span<const shared::TraceRay> rays, std::uint32_t mode,
                        std::vector<float>& distances) const {
    distances.resize(rays.size());
    parallelFor(rays.size(), 4096, [&](std::size_t begin, std::size_t end) {
        for (std::size_t i = begin; i < end; ++i) {
            const shared::TraceRay& ray = rays[i];
            if (mode == shared::kTraceAnyHit) {
                distances[i] = occluded(ray.origin, ray.direction, ray.tMax) ? 0.0f : -1.0f;
            } else {
                const Hit hit = nearest(ray.origin, ray.direction, ray.tMax);
                distances[i] = hit.triangle != Hit::kNone ? hit.t : -1.0f;
            }
        }
    });
}

}  // namespace duolux
