#include "host/loaders/gltf_hierarchy.h"

#include <fmt/format.h>

#include <cmath>
#include <cstddef>
#include <optional>
#include <string>

#include "host/scene/mesh.h"

namespace duolux {

namespace {

glm::dmat4 readMatrix(const JsonNode& node) {
    const std::vector<double> numbers = readNumbers(node, 16, -kFarthestPlace, kFarthestPlace,
                                                    "expected 16 numbers, a matrix column by column");
    glm::dmat4 matrix;
    for (std::size_t i = 0; i < numbers.size(); ++i)
        matrix[static_cast<int>(i / 4)][static_cast<int>(i % 4)] = numbers[i];
    constexpr double kRounding = 1e-5;
    const glm::dvec4 lastRow(matrix[0][3], matrix[1][3], matrix[2][3], matrix[3][3] - 1.0);
    if (!glm::all(glm::lessThanEqual(glm::abs(lastRow), glm::dvec4(kRounding))))
        node.fail("the last row is not 0, 0, 0, 1", "expected an affine transform");
    for (int column = 0; column < 4; ++column)
        matrix[column][3] = column == 3 ? 1.0 : 0.0;
    return matrix;
}

glm::dmat4 readLocal(const JsonNode& node) {
    if (const auto matrix = node.find("matrix")) return readMatrix(*matrix);
    const char* const remedy = "expected three numbers";
    glm::dvec3 translation(0.0), scale(1.0);
    glm::dvec4 rotation(0.0, 0.0, 0.0, 1.0);
    if (const auto given = node.find("translation"))
        translation = given->vector(-kFarthestPlace, kFarthestPlace, remedy);
    if (const auto given = node.find("scale")) scale = given->vector(-kFarthestPlace, kFarthestPlace, remedy);
    if (const auto given = node.find("rotation")) {
        const std::vector<double> numbers =
            readNumbers(*given, 4, -kFarthestPlace, kFarthestPlace, "expected a quaternion, four numbers");
        rotation = glm::dvec4(numbers[0], numbers[1], numbers[2], numbers[3]);
    }
    return transformOf(translation, rotation, scale);
}

class HierarchyReader {
  public:
    HierarchyReader(const GltfDocument& document, GltfNotes& notes)
        : document_(document), notes_(notes), nodes_(document.list("nodes")) {}

    GltfHierarchy run() {
        readChildren();
        hierarchy_.worlds.reserve(nodes_.size());
        for (const JsonNode& node : nodes_)
            hierarchy_.worlds.push_back(readLocal(node));
        placeNodes();
        hierarchy_.scene = preorder(rootsOfScene());
        return std::move(hierarchy_);
    }

  private:
    void readChildren() {
        children_.resize(nodes_.size());
        parents_.resize(nodes_.size());
        for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
            const auto children = nodes_[node].find("children");
            if (!children) continue;
            for (const JsonNode& index : children->elements("expected an array of indices of nodes")) {
                const std::uint32_t child = document_.index(index, "nodes");
                if (parents_[child]) {
                    index.fail(fmt::format("nodes[{}] is also a child of nodes[{}]", child, *parents_[child]),
                               "expected one parent for each node");
                }
                parents_[child] = node;
                children_[node].push_back(child);
            }
        }
    }

    /// The nodes and all below them, parents first, each once.
    std::vector<std::uint32_t> preorder(const std::vector<std::uint32_t>& roots) const {
        std::vector<std::uint32_t> order, stack(roots.rbegin(), roots.rend());
        std::vector<bool> seen(nodes_.size(), false);
        while (!stack.empty()) {
            const std::uint32_t node = stack.back();
            stack.pop_back();
            if (seen[node]) continue;
            seen[node] = true;
            order.push_back(node);
            stack.insert(stack.end(), children_[node].rbegin(), children_[node].rend());
        }
        return order;
    }

    std::vector<std::uint32_t> allRoots() const {
        std::vector<std::uint32_t> roots;
        for (std::uint32_t node = 0; node < nodes_.size(); ++node) {
            if (!parents_[node]) roots.push_back(node);
        }
        return roots;
    }

    void placeNodes() {
        const std::vector<std::uint32_t> order = preorder(allRoots());
        if (order.size() < nodes_.size()) failCycle(order);
        for (const std::uint32_t node : order) {
            if (const auto parent = parents_[node])
                hierarchy_.worlds[node] = hierarchy_.worlds[*parent] * hierarchy_.worlds[node];
        }
    }

    /// Some nodes are below no root.
    [[noreturn]] void failCycle(const std::vector<std::uint32_t>& order) const {
        std::vector<bool> seen(nodes_.size(), false);
        for (const std::uint32_t node : order)
            seen[node] = true;
        std::uint32_t node = 0;
        while (seen[node])
            ++node;
        for (; !seen[node]; node = *parents_[node])
            seen[node] = true;
        nodes_[node].fail("is its own ancestor", "expected nodes that form trees");
    }

    std::vector<std::uint32_t> rootsOfScene() {
        const std::vector<JsonNode>& scenes = document_.list("scenes");
        const auto chosen = document_.root().find("scene");
        if (scenes.empty() && !chosen) return allRoots();
        const auto nodes = scenes[chosen ? document_.index(*chosen, "scenes") : 0].find("nodes");
        std::vector<std::uint32_t> roots;
        if (!nodes) return roots;
        for (const JsonNode& index : nodes->elements("expected an array of indices of nodes")) {
            roots.push_back(document_.index(index, "nodes"));
            if (!parents_[roots.back()]) continue;
            notes_.tolerate(index, "a node of the scene that is a child of another node",
                            "expected nodes without a parent", "its parents move it, too");
        }
        return roots;
    }

    const GltfDocument& document_;
    GltfNotes& notes_;
    const std::vector<JsonNode>& nodes_;
    std::vector<std::vector<std::uint32_t>> children_;
    std::vector<std::optional<std::uint32_t>> parents_;
    GltfHierarchy hierarchy_;
};

}  // namespace

glm::dmat4 transformOf(const glm::dvec3& translation, const glm::dvec4& rotation, const glm::dvec3& scale) {
    const double length = glm::length(rotation);
    const glm::dvec4 q = length > 0.0 && std::isfinite(length) ? rotation / length : glm::dvec4(0, 0, 0, 1);
    glm::dmat4 matrix(1.0);
    matrix[0] = glm::dvec4(1.0 - 2.0 * (q.y * q.y + q.z * q.z), 2.0 * (q.x * q.y + q.w * q.z),
                           2.0 * (q.x * q.z - q.w * q.y), 0.0) *
                scale.x;
    matrix[1] = glm::dvec4(2.0 * (q.x * q.y - q.w * q.z), 1.0 - 2.0 * (q.x * q.x + q.z * q.z),
                           2.0 * (q.y * q.z + q.w * q.x), 0.0) *
                scale.y;
    matrix[2] = glm::dvec4(2.0 * (q.x * q.z + q.w * q.y), 2.0 * (q.y * q.z - q.w * q.x),
                           1.0 - 2.0 * (q.x * q.x + q.y * q.y), 0.0) *
                scale.z;
    matrix[3] = glm::dvec4(translation, 1.0);
    return matrix;
}

GltfHierarchy readGltfHierarchy(const GltfDocument& document, GltfNotes& notes) {
    return HierarchyReader(document, notes).run();
}

}  // namespace duolux
