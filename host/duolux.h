#pragma once

// What programs that render with Duolux include: a scene is loaded (or filled in by the program), rendered on
// a device any number of times, and its film read or written to image files. tests/install/two_views.cpp is
// an example. Failures are exceptions derived from duolux::Error, see host/base/error.h.

#include "host/base/error.h"
#include "host/film/film.h"
#include "host/film/image.h"
#include "host/render/renderer.h"
#include "host/scene/scene.h"
#include "host/view/load.h"
#include "host/vk/device.h"
