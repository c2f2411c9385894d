#include "apps/render/devtools.hpp"

#include <fmt/format.h>

#include <stdexcept>

namespace splashdown::apps {

std::optional<std::string> MessageStream::next() {
  const auto end = bytes_.find('\0', searched_);
  searched_ = end == std::string::npos ? bytes_.size() : 0;
  if (end == std::string::npos) return {};
  auto message = bytes_.substr(0, end);
  bytes_.erase(0, end + 1);
  return message;
}

nlohmann::json DevTools::call(const std::string& method, const nlohmann::json& parameters) {
  nlohmann::json question{{"id", ++last_}, {"method", method}, {"params", parameters}};
  if (!session_.empty()) question["sessionId"] = session_;
  const auto trouble = [&](const std::string& what) {
    return std::runtime_error(fmt::format("the browser {} ({})", what, method));
  };
  if (!channel_.send(question.dump() + '\0')) throw trouble("has ended");
  for (const auto end = std::chrono::steady_clock::now() + patience_;;) {
    for (auto message = messages_.next(); message; message = messages_.next()) {
      const auto answer = nlohmann::json::parse(*message, nullptr, false);
      if (answer.is_discarded() || !answer.is_object()) throw trouble("does not speak the DevTools protocol");
      if (!answer.contains("id") || answer["id"] != last_) continue;  // an event
      if (answer.contains("error")) throw trouble("refuses: " + answer["error"].value("message", std::string("?")));
      return answer.value("result", nlohmann::json::object());
    }
    const auto left = std::chrono::duration_cast<std::chrono::milliseconds>(end - std::chrono::steady_clock::now());
    const auto bytes = channel_.receive(std::max(left, std::chrono::milliseconds(0)));
    if (bytes && bytes->empty()) throw trouble("has ended");
    if (bytes) messages_.add(*bytes);
    if (!bytes && left.count() <= 0)
      throw trouble(fmt::format("does not answer within {} s", std::chrono::duration<double>(patience_).count()));
  }
}

nlohmann::json DevTools::value_of(const std::string& expression) {
  const auto result =
      call("Runtime.evaluate", {{"expression", expression}, {"awaitPromise", true}, {"returnByValue", true}});
  if (result.contains("exceptionDetails")) {
    const auto& details = result["exceptionDetails"];
    throw std::runtime_error("the page fails: " + (details.contains("exception")
                                                       ? details["exception"].value("description", std::string("?"))
                                                       : details.value("text", std::string("?"))));
  }
  return result.contains("result") ? result["result"].value("value", nlohmann::json()) : nlohmann::json();
}

}  // namespace splashdown::apps
