#include "web/tracker/search_message.h"

#include <limits>
#include <optional>
#include <type_traits>

namespace lararium::web {
namespace {

class Writer {
 public:
  explicit Writer(std::vector<double>& numbers) : numbers_(numbers) {}

  template <typename T>
  void Number(T& value) {
    numbers_.push_back(static_cast<double>(value));
  }
  template <typename T>
  void Count(std::vector<T>& items) {
    numbers_.push_back(static_cast<double>(items.size()));
  }
  template <typename T>
  void Has(std::optional<T>& item) {
    numbers_.push_back(item ? 1.0 : 0.0);
  }

 private:
  std::vector<double>& numbers_;
};

class Reader {
 public:
  explicit Reader(std::span<const double> numbers) : numbers_(numbers) {}

  template <typename T>
  void Number(T& value) {
    const double number = Next();
    if constexpr (std::is_floating_point_v<T>) {
      value = static_cast<T>(number);
    } else {
      using Limits = std::numeric_limits<T>;
      const bool fits = number >= Limits::min() && number <= Limits::max();
      ok_ = ok_ && fits;
      value = fits ? static_cast<T>(number) : T();
    }
  }
  // An item takes at least one number.
  template <typename T>
  void Count(std::vector<T>& items) {
    uint32_t count = 0;
    Number(count);
    ok_ = ok_ && count <= numbers_.size() - at_;
    items.resize(ok_ ? count : 0);
  }
  template <typename T>
  void Has(std::optional<T>& item) {
    if (Next() != 0.0) {
      item.emplace();
    }
  }
  bool complete() const { return ok_ && at_ == numbers_.size(); }

 private:
  double Next() {
    ok_ = ok_ && at_ < numbers_.size();
    return ok_ ? numbers_[at_++] : 0.0;
  }

  std::span<const double> numbers_;
  size_t at_ = 0;
  bool ok_ = true;
};

template <typename Archive, typename Derived>
void Describe(Archive& archive, Eigen::PlainObjectBase<Derived>& matrix) {
  for (Eigen::Index i = 0; i < matrix.size(); ++i) {
    archive.Number(matrix.data()[i]);
  }
}

template <typename Archive>
void Describe(Archive& archive, geometry::CameraModel& c) {
  archive.Number(c.width);
  archive.Number(c.height);
  for (double* number : {&c.fx, &c.fy, &c.cx, &c.cy, &c.k1, &c.k2, &c.p1, &c.p2}) {
    archive.Number(*number);
  }
}

template <typename Archive>
void Describe(Archive& archive, vision::CameraEstimate& camera) {
  Describe(archive, camera.model);
  Describe(archive, camera.readout);
  Describe(archive, camera.covariance);
}

template <typename Archive>
void Describe(Archive& archive, geometry::Rigid3& pose) {
  Describe(archive, pose.rotation.coeffs());
  Describe(archive, pose.translation);
}

template <typename Archive, typename T>
void Describe(Archive& archive, std::optional<T>& item) {
  archive.Has(item);
  if (item) {
    Describe(archive, *item);
  }
}

template <typename Archive>
void Describe(Archive& archive, vision::LocatedPoint& point) {
  archive.Number(point.point);
  archive.Number(point.sigma_px);
  Describe(archive, point.pixel);
}

template <typename Archive, typename T>
void Describe(Archive& archive, std::vector<T>& items) {
  archive.Count(items);
  for (T& item : items) {
    Describe(archive, item);
  }
}

template <typename Archive>
void Describe(Archive& archive, vision::Location& location) {
  Describe(archive, location.camera_from_map);
  Describe(archive, location.camera);
  auto reason = static_cast<uint8_t>(location.reason);
  archive.Number(reason);
  location.reason = static_cast<vision::TrackReason>(reason);
  archive.Number(location.matches);
  archive.Number(location.inliers);
  Describe(archive, location.covariance);
  archive.Number(location.expected_error_px);
  archive.Number(location.confidence);
}

template <typename Archive>
void Describe(Archive& archive, SearchQuestion& question) {
  archive.Number(question.number);
  Describe(archive, question.guess.prior);
  Describe(archive, question.guess.candidates);
  Describe(archive, question.guess.predicted);
}

template <typename Archive>
void Describe(Archive& archive, SearchAnswer& answer) {
  archive.Number(answer.number);
  archive.Number(answer.located.map);
  Describe(archive, answer.located.location);
  Describe(archive, answer.points);
}

template <typename Message>
std::vector<double> Written(Message message) {
  std::vector<double> numbers;
  Writer writer(numbers);
  Describe(writer, message);
  return numbers;
}

template <typename Message>
Result<Message> Parsed(std::span<const double> numbers) {
  Message message;
  Reader reader(numbers);
  Describe(reader, message);
  if (!reader.complete()) {
    return Status::Error("search message", "is damaged", "post it as the other worker wrote it");
  }
  return message;
}

}  // namespace

std::vector<double> Numbers(const SearchQuestion& question) { return Written(question); }

std::vector<double> Numbers(const SearchAnswer& answer) { return Written(answer); }

Result<SearchQuestion> ParseQuestion(std::span<const double> numbers) {
  return Parsed<SearchQuestion>(numbers);
}

Result<SearchAnswer> ParseAnswer(std::span<const double> numbers) {
  return Parsed<SearchAnswer>(numbers);
}

}  // namespace lararium::web
