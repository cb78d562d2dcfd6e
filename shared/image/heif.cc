// Reads HEIC and AVIF with libheif. The library is opened by name when the first such picture
// comes, so that programs that never meet one neither load nor need it.

#include <dlfcn.h>
#include <libheif/heif.h>

#include <memory>
#include <opencv2/imgproc.hpp>
#include <type_traits>

#include "shared/image/codecs.h"

namespace lararium::image {
namespace {

// The functions of libheif that are used.
struct Heif {
  decltype(&heif_context_alloc) context_alloc = nullptr;
  decltype(&heif_context_free) context_free = nullptr;
  decltype(&heif_context_read_from_memory_without_copy) read = nullptr;
  decltype(&heif_context_get_primary_image_handle) primary = nullptr;
  decltype(&heif_image_handle_release) handle_release = nullptr;
  decltype(&heif_image_handle_get_width) width = nullptr;
  decltype(&heif_image_handle_get_height) height = nullptr;
  decltype(&heif_decoding_options_alloc) options_alloc = nullptr;
  decltype(&heif_decoding_options_free) options_free = nullptr;
  decltype(&heif_decode_image) decode = nullptr;
  decltype(&heif_image_get_plane_readonly) plane = nullptr;
  decltype(&heif_image_get_width) image_width = nullptr;
  decltype(&heif_image_get_height) image_height = nullptr;
  decltype(&heif_image_release) image_release = nullptr;

  // Returns null if the library is not installed.
  static const Heif* Find() {
    static const std::unique_ptr<const Heif> found = Load();
    return found.get();
  }

 private:
  static std::unique_ptr<const Heif> Load() {
    void* library = dlopen("libheif.so.1", RTLD_NOW | RTLD_LOCAL);
    if (library == nullptr) {
      return nullptr;
    }
    auto heif = std::make_unique<Heif>();
    bool complete = true;
    const auto find = [&](const char* name, auto& function) {
      function =
          reinterpret_cast<std::remove_reference_t<decltype(function)>>(dlsym(library, name));
      complete = complete && function != nullptr;
    };
    find("heif_context_alloc", heif->context_alloc);
    find("heif_context_free", heif->context_free);
    find("heif_context_read_from_memory_without_copy", heif->read);
    find("heif_context_get_primary_image_handle", heif->primary);
    find("heif_image_handle_release", heif->handle_release);
    find("heif_image_handle_get_width", heif->width);
    find("heif_image_handle_get_height", heif->height);
    find("heif_decoding_options_alloc", heif->options_alloc);
    find("heif_decoding_options_free", heif->options_free);
    find("heif_decode_image", heif->decode);
    find("heif_image_get_plane_readonly", heif->plane);
    find("heif_image_get_width", heif->image_width);
    find("heif_image_get_height", heif->image_height);
    find("heif_image_release", heif->image_release);
    return complete ? std::move(heif) : nullptr;
  }
};

struct Deleter {
  const Heif* heif;
  void operator()(heif_context* context) const { heif->context_free(context); }
  void operator()(heif_image_handle* handle) const { heif->handle_release(handle); }
  void operator()(heif_decoding_options* options) const { heif->options_free(options); }
  void operator()(heif_image* image) const { heif->image_release(image); }
};
template <typename T>
using HeifPtr = std::unique_ptr<T, Deleter>;

// A file's first picture, not decoded. `encoded` must outlive it.
struct Primary {
  HeifPtr<heif_context> context;
  HeifPtr<heif_image_handle> handle;
};

Result<Primary> OpenPrimary(Bytes encoded, const std::string& where) {
  const Heif* heif = Heif::Find();
  if (heif == nullptr) {
    return Status::Error(where, "is HEIC or AVIF, and the library that reads it is not installed",
                         "install libheif1, or save the picture as JPEG");
  }
  HeifPtr<heif_context> context(heif->context_alloc(), {heif});
  heif_error error = heif->read(context.get(), encoded.data(), encoded.size(), nullptr);
  heif_image_handle* handle = nullptr;
  if (error.code == heif_error_Ok) {
    error = heif->primary(context.get(), &handle);
  }
  if (error.code != heif_error_Ok) {
    return Damaged(where, error.message);
  }
  return Primary{std::move(context), HeifPtr<heif_image_handle>(handle, {heif})};
}

}  // namespace

// The file begins with the box "ftyp", whose brands name the format (ISO/IEC 23008-12, annex B).
bool IsHeif(Bytes encoded) {
  if (!StartsWith(encoded, 4, "ftyp")) {
    return false;
  }
  constexpr size_t kMostBrands = 16;
  for (size_t at = 8; at < 8 + 4 * kMostBrands; at += 4) {
    for (const char* brand :
         {"heic", "heix", "heim", "heis", "hevc", "hevx", "mif1", "msf1", "avif", "avis"}) {
      if (StartsWith(encoded, at, brand)) {
        return true;
      }
    }
  }
  return false;
}

std::optional<cv::Size> ReadHeifSize(Bytes encoded) {
  const Result<Primary> primary = OpenPrimary(encoded, "picture");
  if (!primary.ok()) {
    return std::nullopt;
  }
  const Heif& heif = *Heif::Find();
  return cv::Size(heif.width(primary->handle.get()), heif.height(primary->handle.get()));
}

Result<cv::Mat> DecodeHeif(Bytes encoded, Channels channels, const std::string& where) {
  LARARIUM_ASSIGN_OR_RETURN(const Primary primary, OpenPrimary(encoded, where));
  const Heif& heif = *Heif::Find();
  const bool alpha = channels == Channels::kBgra;
  const auto width = static_cast<uint64_t>(heif.width(primary.handle.get()));
  const auto height = static_cast<uint64_t>(heif.height(primary.handle.get()));
  // Checks the size before the picture is decoded.
  LARARIUM_ASSIGN_OR_RETURN(cv::Mat image,
                            MakeImage(width, height, alpha ? CV_8UC4 : CV_8UC3, where));
  const HeifPtr<heif_decoding_options> options(heif.options_alloc(), {&heif});
  options->convert_hdr_to_8bit = 1;
  heif_image* decoded = nullptr;
  const heif_error error = heif.decode(
      primary.handle.get(), &decoded, heif_colorspace_RGB,
      alpha ? heif_chroma_interleaved_RGBA : heif_chroma_interleaved_RGB, options.get());
  if (error.code == heif_error_Unsupported_filetype ||
      error.code == heif_error_Unsupported_feature) {
    return Status::Error(where, std::string("cannot be decoded: ") + error.message,
                         "install libheif-plugin-libde265, or save the picture as JPEG");
  }
  if (error.code != heif_error_Ok) {
    return Damaged(where, error.message);
  }
  const HeifPtr<heif_image> pixels(decoded, {&heif});
  int stride = 0;
  const uint8_t* data = heif.plane(pixels.get(), heif_channel_interleaved, &stride);
  if (data == nullptr || heif.image_width(pixels.get(), heif_channel_interleaved) != image.cols ||
      heif.image_height(pixels.get(), heif_channel_interleaved) != image.rows) {
    return Damaged(where, "its pixels have another size than its header says");
  }
  const cv::Mat stored(image.size(), image.type(), const_cast<uint8_t*>(data),
                       static_cast<size_t>(stride));
  cv::cvtColor(stored, image, alpha ? cv::COLOR_RGBA2BGRA : cv::COLOR_RGB2BGR);
  return channels == Channels::kGrey ? Converted(image, channels) : image;
}

}  // namespace lararium::image
