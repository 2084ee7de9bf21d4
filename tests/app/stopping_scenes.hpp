#pragma once

#include <string>

/// Scenes in which no step is acceptable, at order 6.

/// A shear whose very first step is much too long.
inline const std::string stopping_scene =
    "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.5]\n[membrane]\nbending_modulus = 0.1\n"
    "[flow]\nkind = \"shear\"\nrate = 1.0\n"
    "[numerics]\norder = 6\ndt = 1e6\nend_time = 1e7\n[output]\nevery = 1e6\n";

/// A shear that sets in at time 1, much too strong for the step size used until then.
inline const std::string sudden_shear =
    "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 1.5]\n[membrane]\nbending_modulus = 0.1\n"
    "[flow]\nkind = \"shear\"\nrate = 40000.0\n[flow.waveform]\nkind = \"pulse\"\nstart = 1.0\nduration = 5.0\n"
    "[numerics]\norder = 6\ndt = 0.25\nend_time = 2.0\n[output]\nevery = 0.5\n";

/// A disc whose sides touch at every degree; the keys of [numerics] are to be added.
inline const std::string touching_membrane =
    "[shape]\nkind = \"ellipsoid\"\naxes = [1.0, 1.0, 0.001]\n[membrane]\nbending_modulus = 0.1\n[numerics]\n";
