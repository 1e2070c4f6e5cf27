#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>

#include "host/cli/temporary_folder.h"
#include "host/loaders/tally.h"
#include "host/scene/scene.h"

namespace duolux::test {

/// Tests that write scene files to a folder of their own and load them.
class SceneFiles : public testing::Test {
  protected:
    /// Returns the file's path.
    std::filesystem::path write(const std::string& name, std::string_view text) const;

    LoadedScene load(const std::string& name) const;
    LoadedScene loadObj(std::string_view text) const;
    LoadedScene loadJson(std::string_view text) const;

    /// The error line, without the folder; fails if there is no InputError or it has several lines.
    std::string errorOf(const std::string& name, Reading reading = Reading::kLenient) const;
    std::string errorOfObj(std::string_view text, Reading reading = Reading::kLenient) const;
    std::string errorOfJson(std::string_view text) const;

    TemporaryFolder temporary_;
    std::filesystem::path folder_ = temporary_.path();
};

/// One triangle with vertices 1, 2, 3 and a luminaire, so that nothing is added by default.
extern const std::string_view kTriangleObj;

/// Area vector: in the direction of the front's normal, as long as the area.
glm::vec3 areaVector(const Geometry& geometry, std::size_t triangle);
float totalArea(const Geometry& geometry);

MATCHER_P2(IsNear, expected, tolerance, "") {
    return glm::all(glm::lessThanEqual(glm::abs(arg - expected), glm::vec3(tolerance)));
}

}  // namespace duolux::test
