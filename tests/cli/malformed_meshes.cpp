#include <string>
#include <utility>
#include <vector>

#include "tests/cli/malformed_cases.h"

namespace duolux::test {

namespace {

MalformedScene obj(const char* name, const std::string& text, std::vector<std::string> words) {
    return {name, {{"mesh.obj", text}}, std::move(words)};
}

/// A case that only --strict refuses.
MalformedScene strict(MalformedScene scene) {
    scene.onlyIfStrict = true;
    return scene;
}

/// A valid mesh with this MTL.
MalformedScene mtl(const char* name, const std::string& text, std::vector<std::string> words) {
    return {
        name,
        {{"mesh.obj", "mtllib mesh.mtl\nv 0 0 0\nv 1 0 0\nv 0 1 0\nusemtl a\nf 1 2 3\n"}, {"mesh.mtl", text}},
        std::move(words)};
}

const std::string kVertices = "v 0 0 0\nv 1 0 0\nv 0 1 0\n";

}  // namespace

std::vector<MalformedScene> malformedObjs() {
    return {
        obj("Empty", "", {"mesh.obj: ", "has no faces", "\"f\""}),
        obj("NoFaces", kVertices, {"mesh.obj: ", "has no faces"}),
        obj("FlatFaces", "v 0 0 0\nv 1 0 0\nv 2 0 0\nf 1 2 3\n", {"mesh.obj: ", "zero area"}),
        obj("ZeroByte", kVertices + std::string("f 1 2\0 3\n", 9),
            {"mesh.obj: line 4: ", "zero byte", "text file"}),
        obj("WordAsCoordinate", "v 0 0 zero\n" + kVertices,
            {"mesh.obj: line 1: ", "\"zero\"", "\"v x y z\""}),
        strict(obj("NanAsCoordinate", kVertices + "v nan 0 0\nf 1 2 3\n",
                   {"mesh.obj: line 4: ", "\"nan\"", "finite"})),
        strict(obj("InfiniteCoordinate", kVertices + "v 0 -inf 0\nf 1 2 3\n",
                   {"mesh.obj: line 4: ", "\"-inf\"", "finite"})),
        strict(obj("HugeCoordinate", kVertices + "v 0 1e39 0\nf 1 2 3\n",
                   {"mesh.obj: line 4: ", "too large", "1e+09"})),
        strict(obj("TwoCoordinates", kVertices + "v 1 2\nf 1 2 3\n",
                   {"mesh.obj: line 4: ", "2 numbers", "\"v x y z\""})),
        obj("UsedTwoCoordinates", "v 1 2\n" + kVertices + "f 1 2 3\n",
            {"mesh.obj: line 1: ", "2 numbers", "\"v x y z\""}),
        strict(obj("IndexTooLargeInOneFace", kVertices + "f 1 2 3\nf 1 2 4\n",
                   {"mesh.obj: line 5: ", "vertex index 4", "3 vertices"})),
        obj("DecimalComma", "v 0,5 0 0\n", {"mesh.obj: line 1: ", "\"0,5\""}),
        strict(obj("NormalOfTwo", kVertices + "vn 0 1\nf 1 2 3\n",
                   {"mesh.obj: line 4: ", "2 numbers", "\"vn x y z\""})),
        strict(obj("TextureOfWords", kVertices + "vt u v\nf 1 2 3\n",
                   {"mesh.obj: line 4: ", "\"u\"", "\"vt u v\""})),
        obj("IndexTooLarge", kVertices + "f 1 2 4\n", {"mesh.obj: line 4: ", "vertex index 4", "3 vertices"}),
        obj("IndexZero", kVertices + "\nf 0 1 2\n", {"mesh.obj: line 5: ", "vertex index 0", "out of range"}),
        obj("IndexTooFarBack", kVertices + "f -1 -2 -4\n",
            {"mesh.obj: line 4: ", "index -4", "before this line"}),
        obj("IndexBeyondIntegers", kVertices + "f 1 2 18446744073709551617\n",
            {"mesh.obj: line 4: ", "out of range"}),
        strict(obj("NormalIndexTooLarge", kVertices + "vn 0 0 1\nf 1//1 2//1 3//2\n",
                   {"mesh.obj: line 5: ", "normal index 2", "1 normals"})),
        strict(obj("TextureIndexTooLarge", kVertices + "f 1/1 2/1 3/1\n",
                   {"mesh.obj: line 4: ", "texture coordinate index 1"})),
        strict(obj("FaceOfTwo", kVertices + "f 1 2 3\nf 1 2\n",
                   {"mesh.obj: line 5: ", "2 corners", "at least 3"})),
        obj("OnlyAFaceOfTwo", kVertices + "f 1 2\n", {"mesh.obj: ", "has no faces", "3 corners or more"}),
        obj("UsedNanCoordinate", "v nan 0 0\nv 1 0 0\nv 0 1 0\nf 1 2 3\n",
            {"mesh.obj: line 1: ", "\"nan\"", "finite"}),
        obj("GitLfsPointer", "version https://git-lfs.github.com/spec/v1\noid sha256:12\nsize 9\n",
            {"mesh.obj: is a Git LFS pointer", "git lfs pull"}),
        obj("Ply", "ply\nformat ascii 1.0\n", {"mesh.obj: is PLY", "Wavefront OBJ"}),
        strict(obj("TrailingSlash", kVertices + "f 1/ 2/ 3/\n", {"mesh.obj: line 4: ", "\"1/\"", "1//1"})),
        obj("FaceOfWords", kVertices + "f a b c\n", {"mesh.obj: line 4: ", "\"a\"", "1//1"}),
        strict(obj("FaceOfFractions", kVertices + "f 1.0 2.0 3.0\n", {"mesh.obj: line 4: ", "\"1.0\""})),
        strict(obj("SmoothingByWord", "s smooth\n" + kVertices + "f 1 2 3\n",
                   {"mesh.obj: line 1: ", "\"smooth\"", "\"off\""})),
        strict(obj("MaterialWithoutName", kVertices + "usemtl\nf 1 2 3\n",
                   {"mesh.obj: line 4: ", "\"usemtl NAME\""})),
        strict(obj("LibraryWithoutName", "mtllib \n" + kVertices + "f 1 2 3\n",
                   {"mesh.obj: line 1: ", "\"mtllib FILE.mtl\""})),
        {"PlyOfFourBillion",
         {{"mesh.ply",
           "ply\nformat binary_big_endian 1.0\nelement vertex 4294967295\nproperty float x\nproperty float "
           "y\n"
           "property float z\nelement face 1\nproperty list uchar int vertex_indices\nend_header\n"}},
         {"mesh.ply: element vertex: ", "too large", "2^31"}},
        {"PlyCutOff",
         {{"mesh.ply",
           "ply\nformat ascii 1.0\nelement vertex 3\nproperty float x\nproperty float y\nproperty float z\n"
           "element face 1\nproperty list uchar int vertex_indices\nend_header\n0.00 0.00 0.00\n1.00 0.00 "
           "0.00\n0 1"}},
         {"mesh.ply: line 12 (vertex 3 of 3): ", "ends here", "expected 3"}},
        {"PlyThatIsObj", {{"mesh.ply", kVertices}}, {"mesh.ply: line 1: ", "\"ply\""}},
        {"UnknownExtension", {{"mesh.fbx", "solid\n"}}, {"mesh.fbx: ", ".obj", ".ply", ".stl", ".gltf", ".glb", ".json"}},
        {"StlCutOff",
         {{"mesh.stl", "solid\nfacet\nvertex 1 2 3\n"}},
         {"mesh.stl: line 3: ", "within a facet", "\"endfacet\""}},
        {"StlOfFiveBytes", {{"mesh.stl", "soli\n"}}, {"mesh.stl: ", "is 5 bytes", "84 bytes"}},
        {"NoSuchFile", {{"none.obj", "-"}}, {"none.obj: ", "No such file"}},
    };
}

std::vector<MalformedScene> malformedMtls() {
    return {
        strict(mtl("DiffuseOfWord", "newmtl a\nKd red\n", {"mesh.mtl: line 2: ", "\"red\"", "\"Kd r g b\""})),
        strict(mtl("DiffuseMissing", "newmtl a\nKd\n", {"mesh.mtl: line 2: ", "0 numbers", "\"Kd r g b\""})),
        strict(mtl("DiffuseNegative", "newmtl a\n\nKd 1 -0.5 1\n",
                   {"mesh.mtl: line 3: ", "-0.5 is negative", ">= 0"})),
        strict(mtl("DiffuseInfinite", "newmtl a\nKd inf 1 1\n", {"mesh.mtl: line 2: ", "\"inf\"", "finite"})),
        mtl("DiffuseHuge", "newmtl a\nKd 1 1 1e60\n", {"mesh.mtl: line 2: ", "too large", "0 to 1"}),
        strict(
            mtl("EmissionOfTwo", "newmtl a\nKe 1 2\n", {"mesh.mtl: line 2: ", "2 numbers", "\"Ke r g b\""})),
        strict(mtl("EmissionOfFour", "newmtl a\nKe 1 2 3 4\n", {"mesh.mtl: line 2: ", "4 numbers"})),
        mtl("EmissionHuge", "newmtl a\nKe 1 2 1e30\n", {"mesh.mtl: line 2: ", "too large"}),
        strict(mtl("NothingDefined", "Kd 1 1 1\n", {"mesh.mtl: line 1: ", "before any newmtl"})),
        strict(mtl("MaterialWithoutName", "newmtl\nKd 1 1 1\n", {"mesh.mtl: line 1: ", "\"newmtl NAME\""})),
    };
}

}  // namespace duolux::test
