#pragma once

// What drawing may save where a picture takes too long. All of it may change from picture to
// picture; images are allocated anew where their size or samples are others then. What each costs
// and changes: docs/illumination.md.

#include <span>

namespace lararium::render {

// As good as it gets unless set. What lies beyond a range counts as its nearest end.
struct Quality {
  // Of each pixel of people and props, for smooth edges: 1, none, up to what the driver offers.
  int samples = 4;
  // The picture is put together at its own size; otherwise no finer than the camera's image is,
  // and made larger then, people and all.
  bool full_size = true;
  // Pixels of the layer with people, props and caught shadows for one of the picture, as it is put
  // together, along each side: 0.25 to 1.
  float layer_scale = 1.0f;
  // Pixels of the layer, along each side, for one value of the sky's light that real surfaces
  // keep: 4 to 16.
  int shadow_cell = 4;
  // Texels along each side of the maps in which the sun's shadows are looked up: 1024, or 512
  // below that.
  int sun_map = 1024;
  // How often the sun is looked up where a shadow's edge may be: 4 to 14.
  int sun_taps = 14;
  // People and props are lit at each pixel, with the bumps of their surfaces; otherwise at each
  // vertex, without reflections and soft fringes of hair: in a large layer software draws them four
  // times as fast, in a small one no faster.
  bool pixel_light = true;
  // Smooth surfaces mirror what is around; otherwise only where most of the light comes from.
  bool reflections = true;
  // Noise, softness and motion blur of the camera; the camera's image is rectified by shaders then,
  // which can tell its pixels, and by the processor otherwise.
  bool camera_look = true;
  // By how many pixels levels of detail may be off, as errors count (human::ErrorShare), and how
  // many triangles all people together may have (DetailOptions).
  float detail_px = 0.5f;
  int triangles = 300'000;
  // How often textures are half as wide and high: 0 to 3. Where it becomes less they are decoded
  // anew beside drawing; where it becomes more those that are there stay.
  int texture_halvings = 0;

  // People and shadows are drawn over two pictures, while each picture shows those that were ready,
  // turned to where the camera sees them now: they move at half the rate of the picture and a
  // picture or two late (show::ShowRenderer; Renderer::DrawHalf).
  bool half_rate = false;

  friend bool operator==(const Quality&, const Quality&) = default;
};

Quality Clamped(const Quality& quality);

// From the best to the least that still looks good: each step is cheaper by a good part than
// the one before, and changes what is seen least for that (lararium_quality_bench).
std::span<const Quality> QualityLadder();

}  // namespace lararium::render
