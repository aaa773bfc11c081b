/// Scenes for the tests of the device, with many things in them at once.
#pragma once

#include "support/scenes.h"

namespace tyndall::device_test {

/// A ring about the z axis; `normals` adds vertex normals.
Mesh torus_mesh(int rings, int sides, bool normals = false);

/// The camera in the tube of a black torus, which the sky must not find a way into. 256 x 256
/// pixels.
Scene dark_tube();

/// A box that absorbs paths or lets them pass, by one random number each, before a sky of 1:
/// exp(-thickness).
Scene box_of_tosses(double thickness);

/// A room of fog within a box of interfaces: floor, ball, torus with vertex normals, a cloud of
/// another medium, an area light and a dim sky. 16 x 16 pixels.
Scene busy_scene();

/// The same without its lights. Medium 0 fills the room.
Scene dark_scene();

/// One cube of a scattering medium under a uniform sky: needs no hierarchy. 16 x 16 pixels.
Scene plain_scene();

/// The same scene in other units: lengths times `factor`, coefficients over it.
Scene scaled(Scene scene, double factor);
/// The same scene, elsewhere.
Scene moved(Scene scene, const glm::dmat4& by);

} // namespace tyndall::device_test
