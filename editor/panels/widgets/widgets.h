#pragma once

// Widgets that several panels use.

#include <imgui.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec3.hpp>
#include <span>
#include <string>
#include <utility>

#include "editor/panels/widgets/file_kinds.h"
#include "editor/session/workspace.h"
#include "shared/geometry/transform.h"

namespace lararium::panels {

void Heading(const char* text);
void DimText(const std::string& text);
// Dim text with line breaks.
void Hint(const std::string& text);
// Warnings about the thing that is inspected, in their colour.
void DrawWarnings(std::span<const std::string> warnings);
// The warnings with which the product of a thing was baked.
void DrawWarnings(editor::Workspace& workspace, const std::filesystem::path& product);
// The purpose of the last item, shown under the pointer, also while the item is disabled.
void Tooltip(const std::string& text);

// A dialog in the middle of the window, until open is false. Escape and the close button close it;
// Escape first closes a list that is open in it. width: logical pixels.
// flags: beside those of every dialog.
void DrawModal(const char* title,
               float width,
               bool& open,
               const std::function<void()>& content,
               ImGuiWindowFlags flags = 0);

// The reason why the action of a dialog is not possible. Input that is only missing, such as a name
// that was not typed yet, is shown as a hint and not as an error: no dialog begins with an error.
struct DialogProblem {
  std::string text;  // Empty: the action is possible.
  bool missing = false;

  bool any() const { return !text.empty(); }
};
inline DialogProblem Missing(std::string text) { return {std::move(text), true}; }
inline DialogProblem Wrong(std::string text) { return {std::move(text), false}; }

enum class DialogAnswer { kNone, kCancel, kAct };
// Ends a dialog with a row of two buttons: Cancel (or another text) and the action. Enter triggers
// the action unless the focus is on another button.
DialogAnswer DialogButtons(const char* action,
                           const DialogProblem& problem,
                           const char* cancel = nullptr);

// "22 Nov 2026, 14:05", local time. seconds: since 1970.
std::string DateText(int64_t seconds);

// As much of a text as fits into width pixels; an ellipsis replaces the end, or the front.
std::string Elided(const std::string& text, float width);
std::string ElidedFront(const std::string& text, float width);

// A tooltip of the last item, shown while the pointer or the keyboard focus is on it.
void Tip(const std::string& text);

// A row of buttons of which one is selected, on several lines where they do not fit. Returns true
// when the choice has changed. tips: one for each button, or empty.
bool Segmented(const char* id,
               std::span<const char* const> labels,
               int& chosen,
               std::span<const std::string> tips = {});

// A button that plays and pauses, with the same look everywhere.
void PlayButton(editor::Workspace& workspace);

// The width of a button that fits each of the labels, at least least logical pixels.
float WidestButton(std::span<const char* const> labels, float least);

// Whether buttons with these labels fit on the same line, after a gap in pixels (below 0: the
// default).
bool FitsBeside(std::span<const char* const> labels, float gap = -1.0f);
// Continues on the same line if they fit, otherwise on the next line.
void SameLineIfFits(std::span<const char* const> labels, float gap = -1.0f);

// A checkbox whose label can have several lines.
bool CheckRow(const char* label, bool& on);

// A heading that folds its content; returns true while it is open. title: see Label().
bool Fold(const std::string& title, bool open_at_first);

// A grid of labels and values. Values fill the remaining width, or lie below their labels where
// that is small. label_width: logical pixels.
bool BeginProperties(const char* id, float label_width = 92.0f);
void EndProperties();
// Starts a row: the next widget is the value.
void PropertyLabel(const char* label);
void PropertyText(const char* label, const std::string& value);

// A number field without a label. A value that is displayed as zero has no sign: not "-0.000".
bool DragNumber(
    double& value, double speed, const double* min, const double* max, const char* format);

// Number fields in a row of the grid. They return true while the value changes. When the mouse or
// the keyboard releases them, the workspace's gesture ends.
bool NumberProperty(editor::Workspace& workspace,
                    const char* label,
                    double& value,
                    double speed,
                    double min,
                    double max,
                    const char* format);
// A slider, for values whose whole range matters.
bool SliderProperty(editor::Workspace& workspace,
                    const char* label,
                    double& value,
                    double min,
                    double max,
                    const char* format);
// Three numbers, one below the other where a row is too narrow.
bool VectorProperty(editor::Workspace& workspace,
                    const char* label,
                    Eigen::Vector3d& value,
                    double speed,
                    const char* format);
// Degrees of heading (about Y), tilt (about X), roll (about Z).
bool RotationProperty(editor::Workspace& workspace,
                      const char* label,
                      Eigen::Quaterniond& rotation);

// Position, rotation and scale in three rows.
bool TransformProperties(editor::Workspace& workspace, geometry::Similarity3& transform);

// A linear RGB albedo, shown and typed as sRGB.
bool ColourProperty(editor::Workspace& workspace, const char* label, Eigen::Vector3d& albedo);

// Ends the gesture when a drag of the last item ends: the next change is a separate command.
void EndGestureWithItem(editor::Workspace& workspace);

// A list to choose a name from, with the width of the next item. none: the label of the empty name;
// nullptr: the empty name cannot be chosen. Returns true when the choice has changed.
bool NameCombo(const char* id,
               std::string& chosen,
               std::span<const std::string> names,
               const char* none);

// A colour button that opens a picker. srgb: 0..1.
bool Swatch(editor::Workspace& workspace, const char* id, glm::vec3& srgb);

// A path as text, with a button that asks for a file of that type (FileChooser); a file of the type
// that is dropped on the window goes into the field. folder: the base of relative paths. right:
// pixels that stay free beside it.
bool PathField(const char* id,
               std::string& path,
               const std::filesystem::path& folder,
               FileType type,
               float right = 0.0f);

}  // namespace lararium::panels
