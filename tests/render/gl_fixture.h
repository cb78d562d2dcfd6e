#pragma once

#include <gtest/gtest.h>

#include <optional>

#include "shared/render/graphics_context.h"
#include "shared/render/render_target.h"

namespace lararium::render {

// A test that draws off screen.
class GlTest : public ::testing::Test {
 protected:
  void SetUp() override {
    auto context = CreateOffscreenContext();
    ASSERT_TRUE(context.ok()) << context.message();
    context_.emplace(std::move(context).value());
  }

  static RenderTarget MakeTarget(int width, int height) {
    auto target = RenderTarget::Create(width, height);
    EXPECT_TRUE(target.ok()) << target.message();
    return std::move(target).value();
  }

  static cv::Mat Read(const RenderTarget& target) {
    cv::Mat bgr;
    target.ReadPixels(bgr);
    return bgr;
  }

 private:
  std::optional<OffscreenContext> context_;
};

}  // namespace lararium::render
