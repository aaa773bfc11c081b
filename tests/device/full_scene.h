/// A scene that has every effect, or all but one.
#pragma once

#include "scene/scene.h"

#include <string>

namespace tyndall::device_test {

/// A room with something of each kind in it. 12 x 12 pixels.
/// @param missing  an effect as Effects::list names it, which the scene does not have (nor what
/// cannot be without it); none: it has all.
Scene full_scene(const std::string& missing = "");

} // namespace tyndall::device_test
