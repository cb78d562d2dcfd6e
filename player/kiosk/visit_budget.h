#pragma once

// Limits the time of a visit when others wait for the headset. When the time is over, people fade
// out and a text says that the visit is over.

#include <optional>

namespace lararium::player {

// All values are seconds.
struct VisitOptions {
  double longest = 0.0;    // longest time of a visit; 0: no limit
  double fade = 2.0;       // time in which people and sound fade out
  double farewell = 15.0;  // shortest time of the farewell before the next visit can begin
};

class VisitBudget {
 public:
  explicit VisitBudget(const VisitOptions& options = {}) : options_(options) {}

  // Call this when a visitor has come. now: seconds of a steady clock.
  void Begin(double now);
  // Call this for each frame. visited: a visitor is present; the first one who is noticed begins a
  // visit. Returns true once for each visit, when it is over and the farewell was shown long
  // enough: motion from then on is that of the next visitor.
  bool Update(double now, bool visited);

  // True from the end of a visit until the next one begins.
  bool over() const { return over_since_.has_value(); }
  // Results of the last Update(), 0..1: visibility of people and volume; visibility of the
  // farewell.
  float shown() const { return shown_; }
  float farewell() const { return farewell_; }

 private:
  VisitOptions options_;
  std::optional<double> began_;
  std::optional<double> over_since_;
  bool told_ = false;  // Update() has returned true for this visit
  float shown_ = 1.0f;
  float farewell_ = 0.0f;
};

}  // namespace lararium::player
