#include "player/kiosk/visit_budget.h"

#include <algorithm>

namespace lararium::player {

void VisitBudget::Begin(double now) {
  began_ = now;
  over_since_.reset();
  told_ = false;
  shown_ = 1.0f;
  farewell_ = 0.0f;
}

bool VisitBudget::Update(double now, bool visited) {
  if (options_.longest <= 0.0) {
    return false;
  }
  if (!began_ && visited) {
    Begin(now);
  }
  if (began_ && !over_since_ && visited && now - *began_ >= options_.longest) {
    over_since_ = now;
  }
  if (!over_since_) {
    return false;
  }
  const double since = now - *over_since_;
  const auto gone = static_cast<float>(std::clamp(since / options_.fade, 0.0, 1.0));
  shown_ = 1.0f - gone;
  farewell_ = gone;
  if (told_ || since < options_.fade + options_.farewell) {
    return false;
  }
  told_ = true;
  return true;
}

}  // namespace lararium::player
