#pragma once

#include <cstdint>
#include <opencv2/core/mat.hpp>
#include <optional>
#include <span>
#include <vector>

#include "shared/vision/background/background_search.h"
#include "web/tracker/search_message.h"

namespace lararium::web {

// A search by another worker of the page, which has the same maps. Its answer arrives as a message,
// so this cannot wait.
class PostedSearch final : public vision::BackgroundSearch {
 public:
  // The number of points in each map.
  explicit PostedSearch(std::vector<size_t> map_points) : map_points_(std::move(map_points)) {}

  void Begin(const cv::Mat& grey, const vision::CameraGuess& guess) override;
  bool busy() const override { return busy_; }
  std::optional<vision::Located> Take(bool wait) override;
  void Drop() override;
  std::span<const vision::LocatedPoint> points() const override { return taken_.points; }

  // The question that is to be posted with the image; empty if there is none.
  std::span<const double> question() const { return question_; }
  const cv::Mat& image() const { return grey_; }
  // Forgets the question, which was posted.
  void Posted();
  // Takes the answer to the present question; answers to dropped ones are ignored.
  Status Answer(std::span<const double> numbers);

 private:
  std::vector<size_t> map_points_;
  bool busy_ = false;
  uint32_t number_ = 0;
  cv::Mat grey_;
  std::vector<double> question_;
  std::optional<SearchAnswer> answer_;
  SearchAnswer taken_;
};

}  // namespace lararium::web
