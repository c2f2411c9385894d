// Fields in checkpoints.
#pragma once

#include <istream>
#include <ostream>

#include "core/stored.hpp"
#include "elastic/assembly/system.hpp"

namespace splashdown::elastic {

/// Length and entries, bit for bit.
inline void write_field(std::ostream& out, const Field& field) {
  const auto count = static_cast<std::uint64_t>(field.size());
  out.write(reinterpret_cast<const char*>(&count), sizeof count);
  out.write(reinterpret_cast<const char*>(field.data()), static_cast<std::streamsize>(count * sizeof(double)));
}

/// Into a field of the right length. Throws std::runtime_error for other bytes.
inline void read_field(std::istream& in, Field& field) {
  if (stored_count(in, sizeof(double)) != static_cast<std::size_t>(field.size()) ||
      !in.read(reinterpret_cast<char*>(field.data()), static_cast<std::streamsize>(field.size() * sizeof(double))) ||
      !field.allFinite())
    throw std::runtime_error("holds no motion of this solid");
}

}  // namespace splashdown::elastic
