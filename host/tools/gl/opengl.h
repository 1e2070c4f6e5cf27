#pragma once

// OpenGL 4.x compatibility profile, with prototypes of everything that libOpenGL exports.
#define GL_GLEXT_PROTOTYPES
#include <GL/gl.h>
#include <GL/glext.h>
