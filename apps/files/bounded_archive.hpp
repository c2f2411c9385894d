// Reads what cereal's BinaryOutputArchive wrote, from bytes that nobody vouches for: no length is believed that the rest
// of the bytes cannot hold, so that a forged one allocates nothing. Throws std::runtime_error.
#pragma once

#include <cereal/cereal.hpp>
#include <cereal/types/string.hpp>
#include <cereal/types/vector.hpp>
#include <cstdint>
#include <cstring>
#include <stdexcept>
#include <string>
#include <string_view>
#include <type_traits>

namespace splashdown::apps {

class BoundedInputArchive : public cereal::InputArchive<BoundedInputArchive, cereal::AllowEmptyClassElision> {
 public:
  /// The bytes must outlive the archive.
  explicit BoundedInputArchive(std::string_view bytes) : InputArchive(this), rest_(bytes) {}

  void take(void* target, std::uint64_t count) {
    need(count);
    if (count > 0) std::memcpy(target, rest_.data(), count);
    rest_.remove_prefix(count);
  }
  /// Throws unless this many bytes are left.
  void need(std::uint64_t count) const {
    if (count > rest_.size()) throw std::runtime_error("ends too early, or a length in it is wrong");
  }
  std::string_view rest() const { return rest_; }

 private:
  std::string_view rest_;
};

template <class T>
requires std::is_arithmetic_v<T>
void CEREAL_LOAD_FUNCTION_NAME(BoundedInputArchive& archive, T& value) {
  if constexpr (std::is_same_v<T, bool>) {
    char byte = 0;  // any other byte would be no bool at all
    archive.take(&byte, 1);
    value = byte != 0;
  } else {
    archive.take(&value, sizeof value);
  }
}

template <class T>
void CEREAL_LOAD_FUNCTION_NAME(BoundedInputArchive& archive, cereal::BinaryData<T>& data) {
  archive.take(data.data, data.size);
}

template <class T>
void CEREAL_SERIALIZE_FUNCTION_NAME(BoundedInputArchive& archive, cereal::NameValuePair<T>& pair) {
  archive(pair.value);
}

/// Elements take a byte at least.
template <class T>
void CEREAL_SERIALIZE_FUNCTION_NAME(BoundedInputArchive& archive, cereal::SizeTag<T>& tag) {
  archive(tag.size);
  archive.need(tag.size);
}

/// More special than cereal's own, which would make room for all elements at once.
template <class T, class A>
void CEREAL_LOAD_FUNCTION_NAME(BoundedInputArchive& archive, std::vector<T, A>& values) {
  cereal::size_type count = 0;
  archive(cereal::make_size_tag(count));
  if constexpr (std::is_arithmetic_v<T>) {
    archive.need(count <= archive.rest().size() ? count * sizeof(T) : count);
    values.resize(count);
    archive.take(values.data(), count * sizeof(T));
  } else {
    // Elements that are there already know more than what is read, e.g. settings.
    if (values.size() > count) values.erase(values.begin() + static_cast<std::ptrdiff_t>(count), values.end());
    for (auto& value : values) archive(value);
    for (count -= values.size(); count > 0; --count) archive(values.emplace_back());
  }
}

}  // namespace splashdown::apps

CEREAL_REGISTER_ARCHIVE(splashdown::apps::BoundedInputArchive)
