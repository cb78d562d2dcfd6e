#pragma once

// Rotates the coefficients of many receivers at once, each by its own rotation: about Z, Y and Z. A
// rotation about Z mixes only pairs of coefficients; one about Y is one about Z between two quarter
// turns about X (Kautz, Sloan & Snyder, "Fast, Arbitrary BRDF Shading for Low-Frequency Lighting
// Using Spherical Harmonics", EGWR 2002).

#include <span>

#include "shared/light/lanes.h"
#include "shared/light/sh_rows.h"

namespace lararium::light {

// Unit quaternions of receivers. All spans have equal lengths.
struct Turns {
  std::span<const float> w, x, y, z;
};

enum class TurnDirection { kForth, kBack };

// target = coefficients of f(turn^-1 d), or of f(turn d) for the inverse direction. 9, 16 or 25
// rows; range.begin is a multiple of kLanes. Allocates nothing.
void TurnRows(const ShRows& source,
              const Turns& turns,
              TurnDirection direction,
              ReceiverRange range,
              ShRows& target);
void TurnRows(const ShRowsRgb& source,
              const Turns& turns,
              TurnDirection direction,
              ReceiverRange range,
              ShRowsRgb& target);

// Rotation matrices of eight receivers, for directions.
class Turn8 {
 public:
  Turn8(const Turns& turns, size_t begin, size_t valid);

  // Applies the inverse rotation to (x, y, z).
  void Back(Lanes& x, Lanes& y, Lanes& z) const {
    const Lanes turned_x = MultiplyAdd(xx_, x, MultiplyAdd(yx_, y, zx_ * z));
    const Lanes turned_y = MultiplyAdd(xy_, x, MultiplyAdd(yy_, y, zy_ * z));
    const Lanes turned_z = MultiplyAdd(xz_, x, MultiplyAdd(yz_, y, zz_ * z));
    x = turned_x;
    y = turned_y;
    z = turned_z;
  }

 private:
  // xy_ is the x component of the rotated y axis.
  Lanes xx_, xy_, xz_, yx_, yy_, yz_, zx_, zy_, zz_;
};

}  // namespace lararium::light
