#include "shared/render/passes/still_draws.h"

#include <algorithm>

namespace lararium::render {

bool StillDraws::State::Is(const ModelDraw& draw) const {
  return draw.model == model &&
         std::equal(draw.skin.begin(), draw.skin.end(), stage_from_part.begin(),
                    stage_from_part.end()) &&
         std::equal(draw.shown.begin(), draw.shown.end(), shown.begin(), shown.end());
}

void StillDraws::State::Become(const ModelDraw& draw) {
  model = draw.model;
  stage_from_part.assign(draw.skin.begin(), draw.skin.end());
  shown.assign(draw.shown.begin(), draw.shown.end());
}

void StillDraws::Sort(std::span<const ModelDraw> draws) {
  same_ = before_.size() == draws.size();
  before_.resize(draws.size());
  was_still_.resize(draws.size(), 0);
  still_.clear();
  moving_.clear();
  for (size_t i = 0; i < draws.size(); ++i) {
    const bool stands = draws[i].model->skin == GpuModel::Skin::kRigid && before_[i].Is(draws[i]);
    (stands ? still_ : moving_).push_back(draws[i]);
    same_ = same_ && (was_still_[i] != 0) == stands;
    was_still_[i] = stands ? 1 : 0;
    if (!stands) {
      before_[i].Become(draws[i]);
    }
  }
}

void StillDraws::Forget() {
  before_.clear();
  was_still_.clear();
}

}  // namespace lararium::render
