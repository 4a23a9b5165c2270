// The public header of libglint: everything that the program, the tests and the bench use.
//
//   glint_scene, glint_environment     loaded from files            scene/, environment/
//   glint_device                       an open OpenCL device        device/
//   glint_settings → glint_renderer    planned, compiled, uploaded  render/
//   glint_image                        rendered, written to a file  image/
//
// Functions return a glint_status and fill a glint_error (base/status.h). They never print or exit.
#ifndef GLINT_H
#define GLINT_H

#include "accel/bvh_build.h"
#include "base/memory.h"
#include "base/status.h"
#include "base/vector.h"
#include "device/capabilities.h"
#include "device/device.h"
#include "environment/environment.h"
#include "environment/irradiance.h"
#include "image/color.h"
#include "image/image.h"
#include "image/image_io.h"
#include "render/frame.h"
#include "render/layers.h"
#include "render/plan_make.h"
#include "render/plan_tree.h"
#include "scene/camera.h"
#include "scene/scene.h"
#include "scene/shape/topology.h"
#include "selftest/selftest.h"

#endif
