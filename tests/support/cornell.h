#pragma once

#include "host/scene/scene.h"

namespace duolux::test {

/// The Cornell box (Goral et al., SIGGRAPH 1984; dimensions in millimetres as measured at Cornell in 1998),
/// open towards the camera. Materials in this order: white, red, green, light, short, tall.
LoadedScene cornellBox();

enum CornellMaterial : std::uint32_t { kWhite, kRed, kGreen, kLight, kShort, kTall };

/// The box with a different reflectance on every kind of surface: tall block `shadowless`, short block
/// `global`, red wall with full matrices that differ per channel, green wall with a front-only blend, and a
/// small two-sided emitter of visible and invisible light inside.
LoadedScene mixedCornellBox();

/// The box with three kinds of emitter: its luminaire, a two-sided pane inside, and a short block whose top
/// emits only visible light. All surfaces have the scene's reflectance.
LoadedScene lampsCornellBox();

/// The box without its blocks, with a luminaire that the camera sees (the paper's eq. 11): a smooth image.
LoadedScene emptyCornellBox();

}  // namespace duolux::test
