#include <epoxy/gl.h>

#include "editor/window/frame_painter.h"
// epoxy comes first, because ImGui's back end must not include its own OpenGL headers.
#include <gtest/gtest.h>
#include <imgui.h>
#include <imgui_impl_opengl3.h>

#include <opencv2/core.hpp>
#include <optional>
#include <random>
#include <string>
#include <vector>

#include "editor/panels/viewport/picture_textures.h"
#include "shared/core/check.h"
#include "shared/render/gl/graphics_context.h"
#include "shared/render/gl/render_target.h"

namespace lararium::editor {
namespace {

constexpr int kWidth = 320, kHeight = 240;

class FramePainterTest : public testing::Test {
 protected:
  void SetUp() override {
    auto context = render::CreateOffscreenContext();
    if (!context.ok()) {
      GTEST_SKIP() << context.status().message();
    }
    context_.emplace(*std::move(context));
    ImGui::CreateContext();
    ImGuiIO& io = ImGui::GetIO();
    io.IniFilename = nullptr;
    io.DisplaySize = ImVec2(kWidth, kHeight);
    io.DeltaTime = 1.0f / 60.0f;
    CHECK(ImGui_ImplOpenGL3_Init("#version 330 core"));
  }

  void TearDown() override {
    if (context_) {
      ImGui_ImplOpenGL3_Shutdown();
      ImGui::DestroyContext();
    }
  }

  template <typename Show>
  ImDrawData& Frame(const Show& show) {
    ImGui_ImplOpenGL3_NewFrame();
    ImGui::NewFrame();
    show();
    ImGui::Render();
    return *ImGui::GetDrawData();
  }

  static cv::Mat PictureOf(const FramePainter& painter) {
    auto target = render::RenderTarget::Create(kWidth, kHeight);
    CHECK(target.ok());
    painter.CopyInto(target->framebuffer());
    cv::Mat bgr;
    target->ReadPixels(bgr);
    return bgr;
  }

  // What ImGui's back end draws for the complete frame.
  static cv::Mat WholeOf(ImDrawData& frame, const glm::vec3& background) {
    auto target = render::RenderTarget::Create(kWidth, kHeight);
    CHECK(target.ok());
    glBindFramebuffer(GL_FRAMEBUFFER, target->framebuffer());
    glViewport(0, 0, kWidth, kHeight);
    glClearColor(background.r, background.g, background.b, 1.0f);
    glClear(GL_COLOR_BUFFER_BIT);
    ImGui_ImplOpenGL3_RenderDrawData(&frame);
    cv::Mat bgr;
    target->ReadPixels(bgr);
    return bgr;
  }

  std::optional<render::OffscreenContext> context_;
};

const glm::vec3 kBackground(0.1f, 0.2f, 0.3f);

TEST_F(FramePainterTest, PaintsNothingWhereNothingChanges) {
  FramePainter painter;
  const auto show = [] { ImGui::Text("The same"); };
  EXPECT_TRUE(painter.Paint(Frame(show), kBackground));
  Frame(show);  // Lets ImGui settle.
  painter.Paint(Frame(show), kBackground);
  EXPECT_FALSE(painter.Paint(Frame(show), kBackground));
  painter.Forget();
  EXPECT_TRUE(painter.Paint(Frame(show), kBackground));
}

// After any change of the windows, each pixel equals that of a complete repaint.
TEST_F(FramePainterTest, ShowsWhatPaintingTheWholeShows) {
  std::mt19937 random(11);
  const auto pick = [&](int count) { return static_cast<int>(random() % unsigned(count)); };
  struct Box {
    float x = 0, y = 0, share = 0;
    int number = 0;
    bool shown = true;
  };
  std::vector<Box> boxes(5);
  render::Texture texture;
  texture.Upload(cv::Mat(8, 8, CV_8UC3, cv::Scalar(20, 80, 200)));
  FramePainter painter;
  int painted = 0;
  for (int frame = 0; frame < 120; ++frame) {
    Box& box = boxes[size_t(pick(5))];
    switch (pick(6)) {
      case 0:
        box.x = float(pick(200)), box.y = float(pick(150));
        break;
      case 1:
        box.share = 0.01f * float(pick(100));
        break;
      case 2:
        box.number = pick(100000);
        break;
      case 3:
        box.shown = !box.shown;
        break;
      case 4:
        texture.Upload(cv::Mat(8, 8, CV_8UC3, cv::Scalar(pick(255), pick(255), pick(255))));
        break;
      default:
        ImGui::GetIO().MousePos = ImVec2(float(pick(kWidth)), float(pick(kHeight)));
    }
    ImDrawData& data = Frame([&] {
      for (size_t i = 0; i < boxes.size(); ++i) {
        if (!boxes[i].shown) {
          continue;
        }
        ImGui::SetNextWindowPos(ImVec2(boxes[i].x, boxes[i].y));
        ImGui::SetNextWindowSize(ImVec2(120, 90));
        ImGui::SetNextWindowBgAlpha(i % 2 == 0 ? 1.0f : 0.9f);
        ImGui::Begin(("box " + std::to_string(i)).c_str());
        ImGui::ProgressBar(boxes[i].share);
        ImGui::Text("%d", boxes[i].number);
        ImGui::Button("Press");
        if (i == 2) {
          ImGui::Image(panels::ShownTexture(texture), ImVec2(30, 30));
        }
        ImGui::End();
      }
    });
    painted += painter.Paint(data, kBackground) ? 1 : 0;
    const cv::Mat wanted = WholeOf(data, kBackground);
    ASSERT_EQ(cv::norm(PictureOf(painter), wanted, cv::NORM_INF), 0.0) << "frame " << frame;
  }
  EXPECT_GT(painted, 30);
}

TEST_F(FramePainterTest, FollowsTheWindowsSize) {
  FramePainter painter;
  const auto show = [] { ImGui::Text("The same"); };
  painter.Paint(Frame(show), kBackground);
  ImGui::GetIO().DisplaySize = ImVec2(kWidth / 2, kHeight / 2);
  EXPECT_TRUE(painter.Paint(Frame(show), kBackground));
}

}  // namespace
}  // namespace lararium::editor
