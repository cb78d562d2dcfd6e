#pragma once

// Quality settings that trade looks for drawing time. All of them may change from picture to
// picture; images are reallocated when their size or number of samples changes. The cost and the
// effect of each setting are in docs/illumination.md.

#include <span>

namespace lararium::render {

// The defaults are the best quality. Values outside a range are clamped to it (see Clamped).
struct Quality {
  // Samples per pixel of people and props, for smooth edges: from 1 (no antialiasing) to the
  // driver's maximum.
  int samples = 4;
  // True: the picture is composed at its own size. False: it is composed at no more than the
  // resolution of the camera's image, and the result is upscaled.
  bool full_size = true;
  // Width and height of the layer with people, props and caught shadows, divided by those of the
  // composed picture: 0.25 to 1.
  float layer_scale = 1.0f;
  // The share of the sky's light that reaches real surfaces is computed once for each square of
  // shadow_cell x shadow_cell pixels of the layer: 4 to 16.
  int shadow_cell = 4;
  // Width and height of the sun's shadow maps, texels: 1024; smaller values give 512.
  int sun_map = 1024;
  // Number of shadow map samples where a shadow's edge may be: 4 to 14.
  int sun_taps = 14;
  // True: people and props are lit per pixel, with normal maps. False: they are lit per vertex,
  // without reflections and without the soft fringe of hair. In a large layer a software renderer
  // draws them four times as fast; in a small layer there is no gain.
  bool pixel_light = true;
  // True: smooth surfaces reflect the surroundings. False: they reflect the main light only.
  bool reflections = true;
  // Adds noise, softness and motion blur of the camera. If true, shaders rectify the camera's
  // image, because the noise needs the position of its pixels; if false, the processor rectifies
  // it.
  bool camera_look = true;
  // Largest error of levels of detail in pixels (weighted by human::ErrorShare), and the triangle
  // budget of all people together (see DetailOptions).
  float detail_px = 0.5f;
  int triangles = 300'000;
  // Number of times that the width and height of textures are halved: 0 to 3. If the number falls,
  // textures are decoded again in the background; if it rises, loaded textures are kept.
  int texture_halvings = 0;

  // The layer of people and shadows is drawn over the time of two pictures. Meanwhile each picture
  // shows the layer that was finished last, warped to the current pose of the camera. People then
  // move at half the picture rate and one or two pictures late (show::ShowRenderer;
  // Renderer::DrawHalf).
  bool half_rate = false;

  friend bool operator==(const Quality&, const Quality&) = default;
};

Quality Clamped(const Quality& quality);

// Quality settings from the best to the cheapest one that still looks good. Each step is clearly
// cheaper than the one before, at the smallest visible change (measured by lararium_quality_bench).
std::span<const Quality> QualityLadder();

}  // namespace lararium::render
