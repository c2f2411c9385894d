#include "apps/render/browser.hpp"

#include <fmt/format.h>
#include <unistd.h>

#include <stdexcept>
#include <thread>

#include "apps/process/interrupt.hpp"
#include "apps/record/frames/base64.hpp"
#include "apps/text/plain_text.hpp"

namespace splashdown::apps {
namespace {

// A start on a busy machine takes ten seconds, the first picture of a large scene some more.
constexpr std::chrono::seconds patience(120);

std::vector<std::string> words_of(const std::filesystem::path& program, const std::filesystem::path& folder,
                                  std::array<int, 2> size) {
  std::vector<std::string> words{program.string(),
                                 "--headless",
                                 "--remote-debugging-pipe",
                                 "--use-angle=swiftshader",
                                 "--enable-unsafe-swiftshader",
                                 "--disable-dev-shm-usage",  // 64 MB in containers
                                 "--no-first-run",
                                 "--disable-background-networking",
                                 "--disable-component-update",
                                 "--disable-extensions",
                                 "--disable-sync",
                                 "--host-resolver-rules=MAP * ~NOTFOUND",
                                 "--hide-scrollbars",
                                 fmt::format("--window-size={},{}", size[0], size[1]),
                                 "--user-data-dir=" + (folder / "profile").string()};
  if (::geteuid() == 0) words.emplace_back("--no-sandbox");  // Chromium refuses to start as root with it
  words.emplace_back("about:blank");
  return words;
}

/// A path as a URL.
std::string url_of(const std::filesystem::path& path) {
  std::string url = "file://";
  for (const char c : std::filesystem::absolute(path).string()) {
    const auto byte = static_cast<unsigned char>(c);
    url += std::isalnum(byte) || std::string_view("/-_.~").find(c) != std::string_view::npos
               ? std::string(1, c)
               : fmt::format("%{:02X}", byte);
  }
  return url;
}

}  // namespace

std::optional<std::filesystem::path> find_chromium() {
  for (const char* name : {"chromium", "chromium-browser", "google-chrome", "google-chrome-stable"})
    if (auto program = find_program(name)) return program;
  return {};
}

template <class Ask>
auto Browser::asked(const Ask& ask) {
  try {
    return ask();
  } catch (const std::runtime_error& error) {
    const auto words = process_.end() ? last_line(log_) : std::string();
    throw std::runtime_error(words.empty() ? error.what() : fmt::format("{}: {}", error.what(), one_line(words)));
  }
}

Browser::Browser(const std::filesystem::path& program, const std::filesystem::path& folder, std::array<int, 2> size)
    : size_(size),
      log_(folder / "browser.log"),
      process_(words_of(program, folder, size), log_, {{channel_.other_end(), 3}, {channel_.other_end(), 4}}),
      tools_(channel_, patience) {
  channel_.hand_over();
}

Browser::~Browser() {
  process_.kill_group();
  process_.wait();
}

nlohmann::json Browser::value_of(const std::string& expression) {
  return asked([&] { return tools_.value_of(expression); });
}

nlohmann::json Browser::open(const std::filesystem::path& page, const std::string& ready) {
  asked([&] {
    const auto target = tools_.call("Target.createTarget", {{"url", "about:blank"}}).value("targetId", std::string());
    tools_.attach(tools_.call("Target.attachToTarget", {{"targetId", target}, {"flatten", true}})
                      .value("sessionId", std::string()));
    tools_.call("Emulation.setDeviceMetricsOverride",
                {{"width", size_[0]}, {"height", size_[1]}, {"deviceScaleFactor", 1}, {"mobile", false}});
    return tools_.call("Page.navigate", {{"url", url_of(page)}});
  });
  for (const auto end = std::chrono::steady_clock::now() + patience;;) {
    const auto value = value_of(ready);
    if (value != nlohmann::json(false) && !value.is_null() && value != nlohmann::json("")) return value;
    if (std::chrono::steady_clock::now() > end) throw std::runtime_error("the browser does not get the page drawn");
    if (interrupt_received()) throw Interrupted();
    std::this_thread::sleep_for(std::chrono::milliseconds(30));
  }
}

std::string Browser::picture(bool quick) {
  return asked([&] {
    return from_base64(tools_.call("Page.captureScreenshot", {{"format", "png"}, {"optimizeForSpeed", quick}})
                           .value("data", std::string()));
  });
}

}  // namespace splashdown::apps
