#pragma once

// The plain figure, read once for all tests of a program.

#include "editor/import/cast/joint_lookup.h"
#include "editor/import/cast/plain_figure.h"

namespace lararium::import {

inline const human::Human& PlainFigure() {
  static const human::Human figure = LoadPlainFigure().value();
  return figure;
}

inline const human::Skeleton& PlainSkeleton() { return PlainFigure().skeleton; }

}  // namespace lararium::import
