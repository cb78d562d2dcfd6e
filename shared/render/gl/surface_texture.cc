#include "shared/render/gl/surface_texture.h"

#include <epoxy/gl.h>

#include <algorithm>
#include <opencv2/imgproc.hpp>

#include "shared/core/check.h"
#include "shared/render/gl/channel_order.h"

namespace lararium::render {
namespace {

int LargestSide() {
  GLint largest = 0;
  glGetIntegerv(GL_MAX_TEXTURE_SIZE, &largest);
  return std::max(largest, 64);
}

void SetFiltering() {
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MIN_FILTER, GL_LINEAR_MIPMAP_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_MAG_FILTER, GL_LINEAR);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_S, GL_REPEAT);
  glTexParameteri(GL_TEXTURE_2D, GL_TEXTURE_WRAP_T, GL_REPEAT);
  // No anisotropic filtering: Mesa's software rasterizer then reads all texels under a pixel, which
  // takes seconds if a surface is seen edge on.
}

void UploadColour(const cv::Mat& bgra) {
  const cv::Mat image = InUploadOrder(bgra);
  // Four channels, because OpenGL ES cannot generate mipmaps of sRGB textures with three.
  glTexImage2D(GL_TEXTURE_2D, 0, GL_SRGB8_ALPHA8, image.cols, image.rows, 0, GL_RGBA,
               GL_UNSIGNED_BYTE, image.data);
  SwapRedAndBlueIfNeeded();
}

// Uploads x and y only: the shader computes z of the unit normal, which points outwards.
void UploadNormals(const cv::Mat& bgra) {
  cv::Mat xy(bgra.size(), CV_8UC2);
  cv::mixChannels({bgra}, {xy}, {2, 0, 1, 1});
  glPixelStorei(GL_UNPACK_ALIGNMENT, 1);
  glTexImage2D(GL_TEXTURE_2D, 0, GL_RG8, xy.cols, xy.rows, 0, GL_RG, GL_UNSIGNED_BYTE, xy.data);
  glPixelStorei(GL_UNPACK_ALIGNMENT, 4);
}

}  // namespace

GlTexture CreateSurfaceTexture(cv::Mat bgra, TextureUse use) {
  CHECK(bgra.type() == CV_8UC4 && !bgra.empty());
  const int largest = LargestSide();
  while (bgra.cols > largest || bgra.rows > largest) {
    cv::resize(bgra, bgra, cv::Size(std::max(bgra.cols / 2, 1), std::max(bgra.rows / 2, 1)), 0, 0,
               cv::INTER_AREA);
  }
  GlTexture texture = GlTexture::Generate();
  glBindTexture(GL_TEXTURE_2D, texture.id());
  if (use == TextureUse::kColour) {
    UploadColour(bgra.isContinuous() ? bgra : bgra.clone());
  } else {
    UploadNormals(bgra);
  }
  glGenerateMipmap(GL_TEXTURE_2D);
  SetFiltering();
  return texture;
}

GlTexture CreateWhiteTexture() {
  return CreateSurfaceTexture(cv::Mat(1, 1, CV_8UC4, cv::Scalar::all(255)), TextureUse::kColour);
}

}  // namespace lararium::render
