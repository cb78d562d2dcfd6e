#pragma once

// What is known of a camera from image to image. The intrinsics of a visitor's camera are seldom
// known, and they change: autofocus moves the focal length, and phones switch lenses.

#include <vector>

#include "shared/geometry/camera_model.h"
#include "shared/vision/camera_estimate.h"
#include "shared/vision/localizer.h"

namespace lararium::vision {

class CameraFilter {
 public:
  // camera: the intrinsics if they are known; otherwise those of some camera that may be similar,
  // such as the one that the map was trained with. The readout time is always estimated. Known
  // intrinsics are held until the images contradict them, as they do where autofocus moves. Those
  // of the similar camera are held as well, once an image was located with such a lens.
  CameraFilter(const geometry::CameraModel& camera, bool known);

  // Prepares for images of this size. A camera of unknown intrinsics is another one if its images
  // have another shape.
  void SetSize(int width, int height);

  // What is known before an image, `frames` frames after the last one.
  CameraEstimate Predict(double frames) const;
  // What is known before an image that is located without a prior: the lens may be another one.
  CameraGuess Guess() const;
  // The present lens as a guess, for an image that was already followed.
  CameraGuess PresentGuess() const;

  // Takes over the camera of an image that was followed with Predict(). A readout time that
  // contradicts the expected one is left out: the camera jerked, or images are missing.
  void Update(const CameraEstimate& estimate);
  // Takes over the camera of an image that was located with Guess(). Recognises a lens that was in
  // use before, and then knows its intrinsics.
  void Found(const CameraEstimate& found);

  const CameraEstimate& now() const { return now_; }

  // Whether the intrinsics are taken for exactly known.
  bool held() const { return held_; }
  // Whether the next image may have been taken with another lens.
  bool MaySwitch() const { return !told_ || !held_; }
  // Held intrinsics as if they were those of a lens that was used some time ago.
  CameraEstimate Doubted() const;
  // Takes note of the camera of an image that was followed with Doubted(). Where such images go on
  // contradicting the intrinsics, these are not held any more.
  void Contradict(const CameraEstimate& estimate);
  // Whether the last of these images contradicted the intrinsics.
  bool contradicted() const { return contradictions_ > 0; }

 private:
  CameraEstimate Unknown() const;
  // The similar camera, of which only the shutter is not known.
  CameraEstimate Similar() const;

  geometry::CameraModel similar_;
  bool told_;  // similar_ was given as that of the images.
  bool held_;
  bool refuted_ = false;  // Images contradicted similar_.
  CameraEstimate now_;
  std::vector<CameraEstimate> lenses_;  // Lenses that were in use, the present one last.
  int contradictions_ = 0;              // Number of contradictions in a row.
};

}  // namespace lararium::vision
