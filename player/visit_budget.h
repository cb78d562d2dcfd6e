#pragma once

// How long a visit may take, where others wait for the headset: then people go, and what is read
// says that it is over.

#include <optional>

namespace lararium::player {

// Seconds.
struct VisitOptions {
  double longest = 0.0;    // that a visit takes; 0: as long as the visitor stays
  double fade = 2.0;       // in which people, and what is heard, go
  double farewell = 15.0;  // that it is read at least, before the next visit can begin
};

class VisitBudget {
 public:
  explicit VisitBudget(const VisitOptions& options = {}) : options_(options) {}

  // A visitor came. now: seconds of a steady clock.
  void Begin(double now);
  // The next frame; visited: somebody is there. Who is noticed first begins a visit. True once
  // for each visit, when it is over and that could be read: whoever moves from then on is the next.
  bool Update(double now, bool visited);

  // Until the next visit begins.
  bool over() const { return over_since_.has_value(); }
  // Of the last Update(): how much is seen of people and heard, and of the farewell; 0..1.
  float shown() const { return shown_; }
  float farewell() const { return farewell_; }

 private:
  VisitOptions options_;
  std::optional<double> began_;
  std::optional<double> over_since_;
  bool told_ = false;  // that it is over and was read
  float shown_ = 1.0f;
  float farewell_ = 0.0f;
};

}  // namespace lararium::player
