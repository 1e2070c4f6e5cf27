// What both integrators do along a segment of a path.
#include "shaders/lib/material.glsl"
#include "shaders/lib/normal_map.glsl"
#include "shaders/lib/vertex.glsl"

// A surface that a ray along a segment has met.
struct SurfaceHit {
    uint materialIndex;
    Material material;
    Bsdf bsdf;
    SurfacePoint point;
    bool front;          // the ray arrives at the triangle's front
    float cosine;        // between the ray and the normal of the front
    vec3 emissionTexel;  // scales what the surface emits
    float coverage;      // how much of the surface is there
    vec3 unabsorbed;     // the fraction of the light on the segment that glass does not absorb
};

// Scales the parameters of a material by its textures.
void applyTextures(inout Material material, TextureValues values) {
    if (isTextured(kGroupBase)) material.baseColor *= values.base.xyz;
    if (isTextured(kGroupSurface)) {
        material.metallic *= values.surface.x;
        material.roughness *= values.surface.y;
        material.transmission *= values.surface.z;
        material.clearcoat *= values.surface.w;
    }
    if (kCoverage && isTextured(kGroupBase)) material.alpha *= values.base.w;
    if (isTextured(kGroupSpecular)) {
        material.specularColor *= values.specular.xyz;
        material.specular *= values.specular.w;
    }
    if (isTextured(kGroupSheen)) {
        material.sheenColor *= values.sheen.xyz;
        material.sheenRoughness *= values.sheen.w;
    }
    if (isTextured(kGroupNormal)) material.clearcoatRoughness *= values.normal.w;
    if (isTextured(kGroupAnisotropy)) material.anisotropy *= values.anisotropy.z;
}

// The frame of the tangent at a point of a triangle whose front has the unit normal `front`.
TangentFrame tangentFrameAt(Triangle tri, uint triangle, vec2 barycentric, vec3 front) {
    VertexRecords vertices = fetchVertices(triangle);
    bool isSmooth = (tri.materialFlags & kTriangleSmooth) != 0u;
    return tangentFrame(vertices, barycentric, isSmooth ? vertexNormal(vertices, barycentric) : front);
}

// The direction along which anisotropic lobes are stretched: from the tangent, turned by the rotation and the direction
// in the image. `front`: the unit normal of the triangle's front.
vec3 anisotropyTangent(Triangle tri, uint triangle, vec2 barycentric, vec3 front, vec3 shadingNormal, vec2 texel,
                       float rotation) {
    TangentFrame frame;
    frame.normal = front;
    orthonormalBasis(front, frame.tangent, frame.bitangent);
    if (kVertexRecords) frame = tangentFrameAt(tri, triangle, barycentric, front);
    vec2 direction = texel * 2.0 - 1.0;
    vec2 turned = vec2(direction.x * cos(rotation) - direction.y * sin(rotation),
                       direction.x * sin(rotation) + direction.y * cos(rotation));
    vec3 tangent = frame.tangent * turned.x + frame.bitangent * turned.y;
    tangent -= shadingNormal * dot(shadingNormal, tangent);
    vec3 otherwise, bitangent;
    orthonormalBasis(shadingNormal, otherwise, bitangent);
    return dot(tangent, tangent) > 1e-6 ? normalize(tangent) : otherwise;
}

// `viewer`: unit, from the point towards the viewer; `groups`: of the textures that are looked up.
SurfaceHit meetTriangle(Segment segment, Traversal ray, Triangle tri, vec3 viewer, uint groups) {
    SurfaceHit hit;
    hit.materialIndex = tri.materialFlags & kMaterialMask;
    vec3 normal = normalize(cross(tri.v1 - tri.v0, tri.v2 - tri.v0));
    hit.cosine = dot(normal, segment.direction);
    hit.front = hit.cosine < 0.0;
    hit.material = fetchMaterial(hit.materialIndex);
    vec3 colour = vec3(1.0);
    if (kVertexColours) {
        colour = vertexColour(ray.triangle, ray.barycentric);
        hit.material.baseColor *= colour;
        if (kCoverage) hit.material.alpha *= vertexAlpha(ray.triangle, ray.barycentric);
    }
    TextureValues values = noTextures();
    if (kTextureGroups != 0u) {
        values = texturesAt(ray.triangle, hit.materialIndex, groups, ray.barycentric);
        applyTextures(hit.material, values);
    }
    hit.emissionTexel = values.emission.xyz * emissionColour(hit.material.flags, colour);
    hit.bsdf = bsdfOf(hit.material, hit.front);
    hit.coverage = kCoverage ? coverageOf(hit.material) : 1.0;
    hit.unabsorbed = vec3(1.0);
    if (kAttenuates) {
        // The glass at either end of the segment counts, so that both integrators find the same.
        bool fromInside = maxComponent(segment.attenuation) > 0.0;
        vec3 attenuation = fromInside || hit.front ? segment.attenuation : hit.bsdf.attenuation;
        hit.unabsorbed = exp(-attenuation * ray.t);
    }
    // The segment starts at a surface in the same plane, or has crossed one there.
    bool behindOthers = kPlanes && segment.order != kNoTriangle && segment.t == ray.t;
    hit.point = surfacePoint(tri, ray.triangle, ray.barycentric, normal, segment.direction, kSmoothNormals);
    if (hasCoatNormals()) hit.bsdf.coatNormal = hit.point.shadingNormal;
    if (isTextured(kGroupNormal) && kVertexRecords) {
        // A loop, because only loops skip what no lane needs. Without a normal map, and where that is flat, the normal
        // stays as it is.
        uint mapped = values.normal.xyz == noTextures().normal.xyz ? 0u : 1u;
        for (uint i = 0u; i < mapped; i++) {
            TangentFrame frame = tangentFrameAt(tri, ray.triangle, ray.barycentric, normal);
            hit.point.shadingNormal = normalMapped(values.normal.xyz, fetchNormalScale(hit.materialIndex), frame,
                                                   hit.point.geometricNormal, viewer);
        }
    }
    if (hasCoatNormals() && isTextured(kGroupCoatNormal) && kVertexRecords) {
        uint mapped = values.coatNormal.xyz == noTextures().coatNormal.xyz ? 0u : 1u;
        for (uint i = 0u; i < mapped; i++) {
            TangentFrame frame = tangentFrameAt(tri, ray.triangle, ray.barycentric, normal);
            hit.bsdf.coatNormal = normalMapped(values.coatNormal.xyz, fetchCoatNormalScale(hit.materialIndex), frame,
                                               hit.point.geometricNormal, viewer);
        }
    }
    if (kAnisotropic) {
        hit.bsdf.tangent = anisotropyTangent(tri, ray.triangle, ray.barycentric, normal, hit.point.shadingNormal,
                                             values.anisotropy.xy, hit.material.anisotropyRotation);
    }
    hit.point = placedByPlane(hit.point, segment.origin + segment.direction * ray.t, behindOthers);
    return hit;
}

// The segment continues behind the surface that the ray has met.
void crossSurface(inout Segment segment, Traversal ray) {
    segment.t = ray.t;
    segment.order = ray.order;
}

// A path's random numbers for a purpose. `stream` identifies the path: its pixel or number, and the sample.
uvec2 drawWords(uvec2 stream, uint dimension) {
    return sampleWords(kSampler, stream.x, stream.y, dimension, params.seed);
}
vec2 drawPair(uvec2 stream, uint dimension) {
    return samplePair(kSampler, stream.x, stream.y, dimension, params.seed);
}
float drawChoice(uvec2 stream, uint dimension) { return sampleChoice(stream.x, stream.y, dimension, params.seed); }

// The number that chooses between the vertices of a segment (offerVertex). Where no surface is crossed, there is one.
float crossingChoice(uvec2 stream, uint scatterings, uint crossings) {
    float u = 0.0;
    if (kTransparency != kTransparencyZero) {
        u = drawChoice(stream, sampleDimension(scatterings, crossings, kDimensionCrossing));
    }
    return u;
}

// Russian roulette at the end of a segment: whether the path continues. `weight`: what all vertices of the segment
// would carry, in units of the start of the path. `survival`: the probability.
bool survives(uvec2 stream, uint scatterings, uint crossings, float weight, out float survival) {
    survival = scatterings >= 2u ? survivalProbability(weight) : 1.0;
    return drawChoice(stream, sampleDimension(scatterings, crossings, kDimensionRoulette)) < survival;
}

// Without smooth normals a vertex need not keep both normals.
BsdfFrame frameOf(SurfacePoint point, Bsdf bsdf) {
    bool bent = kSmoothNormals || isTextured(kGroupNormal);
    return BsdfFrame(bent ? point.shadingNormal : point.geometricNormal, point.geometricNormal, bsdf.tangent,
                     bsdf.coatNormal);
}

// A ray that leaves a point at which the BSDF scatters.
Segment leaveVertex(SurfacePoint point, Bsdf bsdf, vec3 direction) {
    bool through = kTransmits && dot(point.geometricNormal, direction) < 0.0;
    Segment segment = leaveSurface(point, direction, through);
    if (kAttenuates && isInside(bsdf, through)) segment.attenuation = bsdf.attenuation;
    return segment;
}

// A direction in which a path leaves a vertex.
BsdfSample scatter(Vertex vertex, vec3 wo, vec2 u, uvec2 stream, uint scatterings, uint mode) {
    float lobe = kOnlyDiffuse ? 0.0 : drawChoice(stream, sampleDimension(scatterings, 0u, kDimensionLobe));
    return bsdfSample(vertex.bsdf, frameOf(vertex.point, vertex.bsdf), wo, lobe, u, mode);
}
