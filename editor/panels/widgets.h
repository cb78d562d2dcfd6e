#pragma once

// Small pieces that several panels share.

#include <imgui.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <string>

#include "editor/app/workspace.h"
#include "shared/geometry/transform.h"

namespace lararium::panels {

void Heading(const char* text);
void DimText(const std::string& text);
// Wrapped, dim.
void Hint(const std::string& text);
// What the item before it is for, while it is pointed at; also where it cannot be used now.
void Tooltip(const std::string& text);

// A dialog in the middle of the window, until open is false: Escape and its cross close it, but
// Escape a list first that is open in it.
// width: logical pixels.
void ShowModal(const char* title, float width, bool& open, const std::function<void()>& content);

enum class DialogAnswer { kNone, kCancel, kAct };
// Ends a dialog with a row of Cancel, or what takes its place, and the action, which Enter does too
// unless it presses something else. problem: why the action is not possible yet; empty when it is.
DialogAnswer DialogButtons(const char* action,
                           const std::string& problem,
                           const char* cancel = nullptr);

// "22 Nov 2026, 14:05", local. seconds: since 1970.
std::string DateText(int64_t seconds);

// As much of a text as fits in pixels, with an ellipsis for the rest: its end, or its front.
std::string Elided(const std::string& text, float width);
std::string ElidedFront(const std::string& text, float width);

// What the item before this does, while the mouse or the keyboard is there.
void Tip(const std::string& text);

// A row of buttons of which one is chosen, or several rows where they do not fit; true when the
// choice changed. tips: of each, or none.
bool Segmented(const char* id,
               std::span<const char* const> labels,
               int& chosen,
               std::span<const std::string> tips = {});

// Plays and pauses, the same wherever it is.
void PlayButton(app::Workspace& workspace);

// As wide as a button must be for any of the labels, and at least so many logical pixels.
float WidestButton(std::span<const char* const> labels, float least);

// Whether buttons with these labels fit beside what came before, after a gap of pixels (below 0:
// the usual one).
bool FitsBeside(std::span<const char* const> labels, float gap = -1.0f);
// Where they do they go there, otherwise onto the next line.
void SameLineIfFits(std::span<const char* const> labels, float gap = -1.0f);

// A box to tick; its label takes several lines where it must.
bool CheckRow(const char* label, bool& on);

// A heading that folds what follows away; true while it is open. title: see Label().
bool Fold(const std::string& title, bool open_at_first);

// A grid of label and value; values fill the width that is left, or lie below their labels where
// that is little. label_width: logical pixels.
bool BeginProperties(const char* id, float label_width = 92.0f);
void EndProperties();
// Starts a row: the next widget is the value.
void PropertyLabel(const char* label);
void PropertyText(const char* label, const std::string& value);

// Editors of numbers in a row of the grid. True while the value changes. When
// the mouse or the keyboard lets go, the workspace's gesture ends.
bool NumberProperty(app::Workspace& workspace,
                    const char* label,
                    double& value,
                    double speed,
                    double min,
                    double max,
                    const char* format);
// The same, where the whole range matters.
bool SliderProperty(app::Workspace& workspace,
                    const char* label,
                    double& value,
                    double min,
                    double max,
                    const char* format);
// Three of them, one below the other where they could not be read in a row.
bool VectorProperty(app::Workspace& workspace,
                    const char* label,
                    Eigen::Vector3d& value,
                    double speed,
                    const char* format);
// Degrees of heading (about Y), tilt (about X), roll (about Z).
bool RotationProperty(app::Workspace& workspace, const char* label, Eigen::Quaterniond& rotation);

// Position, rotation and scale: three rows.
bool TransformProperties(app::Workspace& workspace, geometry::Similarity3& transform);

// A linear RGB albedo, shown and typed as the sRGB colour that people know.
bool ColourProperty(app::Workspace& workspace, const char* label, Eigen::Vector3d& albedo);

// The end of a drag of the item before this: the next change is a command of its own.
void EndGestureWithItem(app::Workspace& workspace);

// Chooses one of the names; none: what stands for the empty one, nullptr: there must be one.
// True when another was chosen. As wide as the next item is to be.
bool NameCombo(const char* id,
               std::string& chosen,
               std::span<const std::string> names,
               const char* none);

// A patch of colour that opens a picker. srgb: 0..1.
bool Swatch(app::Workspace& workspace, const char* id, glm::vec3& srgb);

// A path as text, and a button that lists the folder. extensions: with dots,
// lower case; none: folders are chosen. folder: what relative paths start from. right: pixels
// that stay free beside it.
bool PathField(const char* id,
               std::string& path,
               const std::filesystem::path& folder,
               std::span<const char* const> extensions,
               float right = 0.0f);

}  // namespace lararium::panels
