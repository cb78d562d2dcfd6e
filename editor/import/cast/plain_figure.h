#pragma once

// The plain figure: a man of Roman Pompeii in tunic, belt and sandals, who needs no files of the
// user's. He appears in the sample place and wherever no other person is installed. His model comes
// with the editor and is imported as users' models are.

#include <filesystem>
#include <glm/vec3.hpp>

#include "shared/core/status.h"
#include "shared/human/human.h"

namespace lararium::import {

struct PlainFigureOptions {
  float height = 1.72f;                     // metres, from sole to crown
  glm::vec3 tunic = {0.60f, 0.55f, 0.45f};  // linear albedo
};

// The model: scenes/library/figure/figure.glb of the checkout, or its installed copy.
std::filesystem::path PlainFigureFile();

// Clips: walk (loops; its stride fits the feet), idle and look_around (loop), wave (once). Fails if
// the file is missing or damaged.
Result<human::Human> LoadPlainFigure(const PlainFigureOptions& options = {});

}  // namespace lararium::import
