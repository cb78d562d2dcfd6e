#pragma once

// The figure that needs no files: a man of Roman Pompeii in tunic, belt and sandals, made of
// implicit surfaces around an H-Anim skeleton. He appears in the sample place and wherever no
// other person is installed.

#include <glm/vec3.hpp>

#include "shared/human/human.h"

namespace lararium::import {

// Colours are linear albedo.
struct PlainFigureOptions {
  float height = 1.72f;  // metres, from sole to crown
  glm::vec3 skin = {0.45f, 0.28f, 0.20f};
  glm::vec3 hair = {0.045f, 0.030f, 0.022f};
  glm::vec3 tunic = {0.60f, 0.55f, 0.45f};
  glm::vec3 belt = {0.16f, 0.08f, 0.04f};
  glm::vec3 sandals = {0.20f, 0.11f, 0.06f};
};

// Clips: walk (loops; its stride fits the feet), idle and look_around (loop), wave (once).
// Equal options give equal humans.
human::Human BuildPlainFigure(const PlainFigureOptions& options = {});

}  // namespace lararium::import
