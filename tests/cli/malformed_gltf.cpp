#include <string>
#include <utility>
#include <vector>

#include "tests/cli/malformed_cases.h"

namespace duolux::test {

namespace {

/// The bytes of a triangle at (0, 0, 0), (1, 0, 0), (0, 1, 0) as floats.
const std::string kUri = "data:;base64,AAAAAAAAAAAAAAAAAACAPwAAAAAAAAAAAAAAAAAAgD8AAAAA";

/// A glTF file of one triangle in which the first occurrence of a text is replaced.
MalformedScene gltf(const char* name, const std::string& from, const std::string& to,
                    std::vector<std::string> words) {
    std::string text = R"({"asset": {"version": "2.0"},
  "nodes": [{"mesh": 0, "scale": [1, 1, 1]}, {"children": [0]}],
  "meshes": [{"primitives": [{"attributes": {"POSITION": 0}}]}],
  "accessors": [{"bufferView": 0, "byteOffset": 0, "componentType": 5126, "type": "VEC3", "count": 3}],
  "bufferViews": [{"buffer": 0, "byteLength": 36}],
  "buffers": [{"byteLength": 36, "uri": ")" +
                       kUri + "\"}]}";
    text.replace(text.find(from), from.size(), to);
    return {name, {{"mesh.gltf", text}}, std::move(words)};
}

}  // namespace

std::vector<MalformedScene> malformedGltfs() {
    return {
        gltf("CutOff", "\"}]}", "", {"mesh.gltf: line 6, column ", "JSON"}),
        gltf("NotJson", "{", "mtllib a.mtl {",
             {"mesh.gltf: line 1, column 1", "expected glTF JSON or binary glTF"}),
        gltf("OldVersion", "2.0", "1.0", {"mesh.gltf: asset.version: ", "\"1.0\"", "\"2.0\""}),
        gltf("UnknownExtension", "\"nodes\"", "\"extensionsRequired\": [\"ACME_x\"], \"nodes\"",
             {"mesh.gltf: extensionsRequired[0]: ", "\"ACME_x\"", "not supported"}),
        gltf("NodeCycle", "\"scale\"", "\"children\": [1], \"scale\"",
             {"mesh.gltf: nodes[0]: ", "its own ancestor", "trees"}),
        gltf("FlatNode", "[1, 1, 1]", "[0, 1, 1]", {"mesh.gltf: ", "zero area"}),
        gltf("MeshOutOfRange", "\"mesh\": 0", "\"mesh\": 1",
             {"mesh.gltf: nodes[0].mesh: is 1", "expected 0"}),
        gltf("AccessorOverrun", "\"count\": 3", "\"count\": 4",
             {"mesh.gltf: accessors[0]: 4 elements", "36 bytes", "expected at least 48"}),
        gltf("ComponentType", "5126", "5130", {"mesh.gltf: accessors[0].componentType: is 5130", "5126"}),
        gltf("ViewOverrun", "\"byteLength\": 36", "\"byteLength\": 40",
             {"mesh.gltf: bufferViews[0]: takes 40 bytes", "expected a part of the buffer"}),
        gltf("BrokenBase64", "AAA", "A A", {"mesh.gltf: buffers[0].uri: ", "not base64"}),
        gltf("BufferCutOff", "AAAAAAAA", "", {"mesh.gltf: buffers[0]: has 30 bytes; expected 36"}),
        gltf("BufferMissing", kUri, "none.bin", {"mesh.gltf: buffers[0].uri: no file none.bin"}),
        gltf("BufferOnTheWeb", kUri, "https://example.com/a.bin", {"mesh.gltf: buffers[0].uri: is \"https:"}),
        gltf("Nan", "AACAPwAA", "AADAfwAA", {"mesh.gltf: accessors[0]: element 1 is not finite"}),
        {"BinaryCutOff",
         {{"mesh.glb", std::string("glTF\2\0\0\0\0\1\0\0", 12)}},
         {"mesh.glb: byte 12: the file ends here"}},
        {"BinaryThatIsPly", {{"mesh.glb", "ply\n"}}, {"mesh.glb: is PLY", "expected glTF"}},
    };
}

}  // namespace duolux::test
