// Checkpoints. Bytes that begin with 'r' are the file itself; others change a good one: places and what stands there.
#include "apps/simulation/checkpoint.hpp"

#include <fstream>
#include <iterator>

#include "reader.hpp"

namespace {

std::string good_one() {
  splashdown::apps::Checkpoint checkpoint;
  checkpoint.scene = "title = \"\"\n";
  checkpoint.phases["mesh"] = 1;
  checkpoint.stepper = std::string(40, 's');
  checkpoint.recorder = std::string(40, 'r');
  const auto folder = splashdown::fuzz::folder() / "good";
  splashdown::apps::write_checkpoint(folder, checkpoint);
  std::string bytes;
  for (const auto& entry : std::filesystem::directory_iterator(folder)) {
    std::ifstream in(entry.path(), std::ios::binary);
    bytes.assign(std::istreambuf_iterator<char>(in), {});
  }
  return bytes;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  using namespace splashdown;
  static const std::string good = good_one();
  std::string bytes = good;
  if (size > 0 && data[0] == 'r') {
    bytes = fuzz::text_of(data + 1, size - 1);
  } else {
    for (std::size_t i = 0; i + 2 < size; i += 3)
      bytes[(data[i] * 256u + data[i + 1]) % bytes.size()] = static_cast<char>(data[i + 2]);
  }
  fuzz::file_of("checkpoint/state", reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
  apps::read_checkpoints(fuzz::folder() / "checkpoint");  // throws for nothing that a file holds
  return 0;
}
