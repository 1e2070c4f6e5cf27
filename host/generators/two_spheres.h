#pragma once

#include <cstddef>
#include <filesystem>

namespace duolux {

/// Bounds on the number of triangles that writeTwoSpheres accepts.
inline constexpr std::size_t kFewestTwoSpheresTriangles = 100;
inline constexpr std::size_t kMostTwoSpheresTriangles = 50'000'000;

/// Writes the scene of the paper's evaluation (section 3) as FOLDER/two_spheres.{obj,mtl,json}: two spheres
/// under a rectangular luminaire that emits only invisible light, in a room that is open to the camera. The
/// number of triangles is within 1 % of `triangles`, most of them in the spheres (evenly divided icosahedra
/// without slivers). Returns the exact number. Throws MachineError if the files cannot be written.
std::size_t writeTwoSpheres(const std::filesystem::path& folder, std::size_t triangles);

}  // namespace duolux
