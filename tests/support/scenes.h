/// Scenes by hand, among the things that tests are made of.
#pragma once

#include "scene/by_hand.h"

namespace tyndall::support {

using namespace by_hand;

} // namespace tyndall::support
