#pragma once

// Finds where a frame of the interface differs from the one before, so that only that part is
// drawn: most of a window does not change from frame to frame.

#include <imgui.h>

#include <cstddef>
#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace lararium::panels {

// Pixels of ImGui's display from its top-left corner. Empty where from is not less than to.
struct DamageRect {
  float from_x = 0.0f, from_y = 0.0f, to_x = 0.0f, to_y = 0.0f;

  bool empty() const { return from_x >= to_x || from_y >= to_y; }
  float area() const { return empty() ? 0.0f : (to_x - from_x) * (to_y - from_y); }
  friend bool operator==(const DamageRect&, const DamageRect&) = default;
};
DamageRect Union(const DamageRect& a, const DamageRect& b);
DamageRect Intersection(const DamageRect& a, const DamageRect& b);

// ImGui's identifier of a texture: OpenGL's name in the low half, which the back end uses, and the
// version of its content in the high half. A draw command therefore differs when the picture has
// changed.
ImTextureID TextureOf(uint32_t id, uint32_t version);

class FrameDamage {
 public:
  static constexpr size_t kMostRects = 6;

  // Processes the next frame. Returns rectangles of whole pixels within the display, disjoint where
  // that saves area; none where the frame is equal to the last one. The first frame, a frame of
  // another size, or one with windows in another order is returned as a whole.
  std::span<const DamageRect> Next(const ImDrawData& frame);
  // The whole next frame will be drawn.
  void Forget() { known_ = false; }

 private:
  // The draw commands of an ImGui window.
  struct Layer {
    std::string name;
    std::vector<ImDrawVert> vertices;
    std::vector<ImDrawIdx> indices;
    std::vector<ImDrawCmd> commands;
  };
  // A triangle of a layer.
  struct Triangle {
    ImDrawVert corners[3];
    ImVec4 clip;
    ImTextureID texture;
  };

  static void Copy(const ImDrawList& list, Layer& layer);
  static bool Same(const Layer& a, const Layer& b);
  static bool Same(const Triangle& a, const Triangle& b);
  static void Read(const Layer& layer, std::vector<Triangle>& triangles);
  // Returns false where windows of the last frame are in another order.
  bool CompareLayers();
  void Compare(const Layer& before, const Layer& now);
  void AddTriangle(const Triangle& triangle);
  void AddRect(const DamageRect& rect);

  bool known_ = false;
  ImVec2 size_ = ImVec2(0, 0);
  std::vector<Layer> before_;
  std::vector<Layer> now_;
  std::vector<Triangle> triangles_before_;  // Triangles of the layer that is compared.
  std::vector<Triangle> triangles_now_;
  std::vector<DamageRect> rects_;
};

}  // namespace lararium::panels
