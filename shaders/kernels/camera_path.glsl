// Paths from the camera.

// A path in flight.
struct Path {
    uvec2 stream;                  // pixel and sample
    ReflectanceMatrix importance;  // W on the segment, after all surfaces crossed so far
    Segment segment;
    float bsdfPdf;                 // density of the segment's direction, per steradian
    uint scatterings;              // events before the segment
    uint crossings;                // on the segment
    bool ended;
    ReflectanceMatrix scattered;   // W O at the chosen vertex of the segment
};

Path cameraPath(uvec2 stream) {
    vec2 corner = pixelCorner(params.camera, stream.x);
    CameraRay ray = cameraRay(params.camera, corner + drawPair(stream, kDimensionPixel));
    Path path;
    path.stream = stream;
    path.importance = matrixIdentity();
    path.segment = Segment(ray.origin, ray.direction, 0.0, kNoTriangle, vec3(0.0));
    path.bsdfPdf = 0.0;
    path.scatterings = 0u;
    path.crossings = 0u;
    path.ended = false;
    return path;
}

bool onCameraSegment(Path path) { return path.scatterings + path.crossings == 0u; }

bool onlyEmissionLeft(Path path) {
    return path.scatterings >= params.bounces || !canScatter(path.importance);
}

// Whether every T passes the importance of the path unchanged. On the way from the camera, the second column may carry
// importance, which surfaces stop.
bool passesAll(Path path) {
    bool secondColumn = kSecondColumn && maxComponent(path.importance.m01 + path.importance.m11) > 0.0;
    return kTransparency == kTransparencyIdentity && !secondColumn;
}

// Without a second column, the first column carries all importance, except on the camera's own segment. Behind surfaces
// of which only a part is there, that segment still carries the same importance for both components.
ReflectanceMatrix importanceOf(Path path) {
    if (kSecondColumn) return path.importance;
    vec3 second = onCameraSegment(path) ? vec3(1.0) : vec3(0.0);
    if (kTransparency == kTransparencyCoverage) second = path.scatterings == 0u ? path.importance.m00 : vec3(0.0);
    return ReflectanceMatrix(path.importance.m00, vec3(0.0), path.importance.m10, second);
}
