#pragma once

// Where a frame of the interface differs from the one before, so that only that is drawn:
// most of a window stands still most of the time.

#include <imgui.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lararium::panels {

// Pixels of ImGui's display, from the top-left corner; empty where from is not less than to.
struct DamageRect {
  float from_x = 0.0f, from_y = 0.0f, to_x = 0.0f, to_y = 0.0f;

  bool empty() const { return from_x >= to_x || from_y >= to_y; }
  float area() const { return empty() ? 0.0f : (to_x - from_x) * (to_y - from_y); }
  friend bool operator==(const DamageRect&, const DamageRect&) = default;
};
DamageRect Union(const DamageRect& a, const DamageRect& b);
DamageRect Intersection(const DamageRect& a, const DamageRect& b);

// How ImGui is told of a texture: OpenGL's name in the low half, which is what its back end
// takes, and the version of what it shows in the high one. So a command differs from the
// last frame's when the picture does.
ImTextureID TextureOf(uint32_t id, uint32_t version);

class FrameDamage {
 public:
  static constexpr size_t kMostRects = 6;

  // The next frame. Whole pixels within the display, apart from each other as far as that
  // saves area; none where it looks like the last one. All of the first frame, and of one
  // of another size or with its windows in another order.
  std::span<const DamageRect> Next(const ImDrawData& frame);
  // All of the next frame is to be drawn.
  void Forget() { known_ = false; }

 private:
  // What a window draws, as ImGui has it.
  struct Layer {
    std::string name;
    std::vector<ImDrawVert> vertices;
    std::vector<ImDrawIdx> indices;
    std::vector<ImDrawCmd> commands;
  };
  // A triangle of it.
  struct Triangle {
    ImDrawVert corners[3];
    ImVec4 clip;
    ImTextureID texture;
  };

  static void Copy(const ImDrawList& list, Layer& layer);
  static bool Same(const Layer& a, const Layer& b);
  static bool Same(const Triangle& a, const Triangle& b);
  static void Read(const Layer& layer, std::vector<Triangle>& triangles);
  // False where windows that were there before lie in another order.
  bool CompareLayers();
  void Compare(const Layer& before, const Layer& now);
  void AddTriangle(const Triangle& triangle);
  void AddRect(const DamageRect& rect);

  bool known_ = false;
  ImVec2 size_ = ImVec2(0, 0);
  std::vector<Layer> before_;
  std::vector<Layer> now_;
  std::vector<Triangle> triangles_before_;  // of the layer being compared
  std::vector<Triangle> triangles_now_;
  std::vector<DamageRect> rects_;
};

}  // namespace lararium::panels
