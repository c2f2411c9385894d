#include "apps/report/page.hpp"

#include <fmt/format.h>

#include <string_view>

#include "apps/report/look/theme.hpp"

namespace splashdown::apps {

namespace {

constexpr std::string_view style = R"(
*{box-sizing:border-box}
body{margin:0;background:var(--ground);color:var(--ink);font:16px/1.5 system-ui,-apple-system,"Segoe UI","Helvetica Neue",Arial,sans-serif}
main{max-width:1180px;margin:0 auto;padding:32px 24px 64px}
h1{font-size:30px;line-height:1.2;margin:0 0 4px;letter-spacing:-.01em}
h2{font-size:20px;margin:40px 0 12px;letter-spacing:-.005em}
h1,h2{overflow-wrap:anywhere}
.where{color:var(--soft);margin:0 0 20px;font-size:14px;overflow-wrap:anywhere}
.verdict{background:var(--paper);border:1px solid var(--line);border-left:6px solid;border-radius:8px;padding:18px 22px}
.verdict.good{border-left-color:var(--good-edge)}.verdict.fair{border-left-color:var(--fair-edge)}.verdict.bad{border-left-color:var(--bad-edge)}
.verdict strong{display:block;font-size:19px;margin-bottom:6px}
.verdict p{margin:3px 0;overflow-wrap:anywhere}
.verdict b.bad{color:var(--bad)}.verdict b.fair{color:var(--fair)}
.verdict p:has(.head){display:grid;grid-template-columns:3.6em minmax(0,1fr)}.verdict .head{font-weight:600}
.verdict details{font-size:14px;color:var(--soft)}.verdict summary{cursor:pointer}.verdict ul{margin:6px 0 0;padding-left:20px}
.verdict.bad{background:var(--bad-ground)}.verdict.fair{background:var(--fair-ground)}
.tiles{display:grid;grid-template-columns:repeat(auto-fit,minmax(min(100%,190px),1fr));gap:12px;margin:16px 0 0}
.tile{min-width:0;overflow-wrap:anywhere;background:var(--paper);border:1px solid var(--line);border-radius:8px;padding:12px 16px}
.tile b{display:block;font-size:22px;line-height:1.25;font-variant-numeric:tabular-nums}
.tile span{display:block;color:var(--soft);font-size:13px;line-height:1.4}
.tile span.good{color:var(--good)}.tile span.fair{color:var(--fair)}.tile span.bad{color:var(--bad)}
.tile svg{display:block;margin:6px 0 2px;max-width:100%}
@media (min-width:700px){.tile.wide{grid-column:span 2;position:relative}.tile.wide:has(svg){padding-right:200px}.tile.wide svg{position:absolute;right:16px;top:12px}}
@media (min-width:1000px){.tile.wide:has(svg){grid-column:span 3}}
.quiet{color:var(--soft);font-size:13px;margin:12px 2px 0;overflow-wrap:anywhere}
.bar{display:flex;height:26px;border-radius:6px;overflow:hidden;background:var(--line)}
.bar div{min-width:1px}
.legend{display:flex;flex-wrap:wrap;gap:4px 20px;margin:10px 0 0;padding:0;list-style:none;font-size:14px;color:var(--soft)}
.legend i{display:inline-block;width:11px;height:11px;border-radius:3px;margin-right:7px}
.grid{display:grid;grid-template-columns:repeat(auto-fill,minmax(min(100%,500px),1fr));gap:16px}
figure{margin:0;background:var(--paper);border:1px solid var(--line);border-radius:8px;padding:14px 16px 12px}
figure svg,figure img{display:block;width:100%;height:auto}
.sideways{overflow-x:auto}.sideways svg{min-width:560px}figure.heat{padding-bottom:16px}.scroll+figure,figure+.scroll{margin-top:16px}
.views .row{display:flex;flex-wrap:wrap;gap:12px 28px;align-items:flex-end}.views .row>div{max-width:100%}.views svg{max-width:100%}
.copy{position:relative}.copy pre{background:var(--code);border-radius:6px;padding:10px 64px 10px 12px;white-space:pre-wrap;overflow-wrap:anywhere}.details .copy pre{white-space:pre}
.copy button{position:absolute;right:8px;top:8px;font:12px system-ui,sans-serif;color:var(--link);background:var(--paper);border:1px solid var(--line);border-radius:5px;padding:2px 8px;cursor:pointer}
.pick{margin-right:8px}.pair{display:flex;flex-wrap:wrap;gap:8px 24px;margin:0 0 12px}.pair i{display:inline-block;width:11px;height:11px;border-radius:3px;margin-right:7px}
.pair select{font:14px system-ui,sans-serif;color:var(--ink);background:var(--paper);border:1px solid var(--line);border-radius:6px;padding:4px 8px;max-width:100%}.scroll+.grid{margin-top:16px}
figcaption{color:var(--soft);font-size:14px;margin-top:8px}
figcaption b{color:var(--ink)}
.heat td{background:color-mix(in srgb,var(--heat) var(--s,0%),var(--paper));text-align:center}.heat td a{color:var(--ink);text-decoration:none}.heat td a:hover{text-decoration:underline}
.heat td.none{color:var(--bad);background:var(--ground)}.heat figcaption{margin:0 0 8px}.heat tbody th{color:var(--soft);font-weight:600}
.bars td{text-align:left}.bars td.length{background:linear-gradient(90deg,color-mix(in srgb,var(--heat) 45%,var(--paper)) calc(.92*var(--s)),transparent calc(.92*var(--s)))}
.bars td.spot{background:linear-gradient(90deg,transparent calc(var(--s) - 4px),var(--heat) calc(var(--s) - 4px),var(--heat) calc(var(--s) + 4px),transparent calc(var(--s) + 4px))}
.bars td.none{color:var(--bad)}.bars td span{background:color-mix(in srgb,var(--paper) 70%,transparent);border-radius:4px;padding:1px 4px}
.scroll{overflow-x:auto;background:var(--paper);border:1px solid var(--line);border-radius:8px}
table{border-collapse:collapse;width:100%;font-size:14px;font-variant-numeric:tabular-nums}
th,td{text-align:right;padding:7px 14px;border-top:1px solid var(--line);white-space:nowrap}
th:first-child,td:first-child{text-align:left}
thead th{border-top:0;color:var(--soft);font-weight:600}
td.good{color:var(--good)}td.fair{color:var(--fair)}td.bad{color:var(--bad)}
th.text,td.text{text-align:left}
td.text{white-space:normal;min-width:16em}
.note{background:var(--fair-ground);border:1px solid var(--fair-line);border-radius:8px;padding:12px 16px;margin:16px 0 0}
a{color:var(--link)}
code{font:13px/1.4 ui-monospace,SFMono-Regular,Menlo,Consolas,monospace;background:var(--code);border-radius:4px;padding:1px 5px;overflow-wrap:anywhere}
details.scene{background:var(--paper);border:1px solid var(--line);border-radius:8px;padding:12px 16px}details.scene summary{cursor:pointer;font-size:14px;color:var(--soft)}
pre{font:12px/1.45 ui-monospace,SFMono-Regular,Menlo,Consolas,monospace;overflow-x:auto;margin:10px 0 0}
footer{color:var(--soft);font-size:13px;margin-top:40px}
@media (max-width:480px){main{padding:18px 12px 40px;display:flex;flex-direction:column}main>h1,main>.where,main>.verdict.bad,main>.tiles{order:-1}h1{font-size:24px}.verdict{padding:14px 14px}.tile{padding:10px 12px}.tiles{grid-template-columns:repeat(auto-fit,minmax(min(100%,150px),1fr))}th,td{padding:6px 9px}figure{padding:10px 8px}}
@media print{body{background:#fff}figure,.verdict,.tile{break-inside:avoid}#replay,h2:has(+style+#replay){display:none}}
)";

void replace_all(std::string& text, std::string_view from, std::string_view to) {
  for (std::size_t at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size()))
    text.replace(at, from.size(), to);
}

}  // namespace

const char* css_class(Mood mood) {
  switch (mood) {
    case Mood::good:
      return "good";
    case Mood::fair:
      return "fair";
    case Mood::bad:
      break;
  }
  return "bad";
}

std::string folder_name(const std::filesystem::path& directory) {
  const auto folder = std::filesystem::absolute(directory).lexically_normal();
  return (folder.filename().empty() ? folder.parent_path() : folder).filename().string();
}

std::string html_header(const std::string& title, const std::filesystem::path& directory, const Banner& banner,
                        const std::vector<std::string>& warnings) {
  std::string html =
      fmt::format("<h1>{}</h1>\n<p class=\"where\">{}</p>\n<section class=\"verdict {}\"><strong>{}</strong>\n",
                  html_escaped(title), html_escaped(std::filesystem::absolute(directory).lexically_normal().string()),
                  css_class(banner.mood), html_escaped(banner.headline));
  for (const auto& sentence : banner.sentences)
    html += sentence.starts_with("<details") ? sentence + "\n" : "<p>" + sentence + "</p>\n";
  html += "</section>\n";
  for (const auto& warning : warnings) html += "<div class=\"note\">" + warning + "</div>\n";
  return html;
}

std::string html_tile(const std::string& value, const std::string& rows, const char* classes) {
  return fmt::format("<div class=\"{}\"><b>{}</b>{}</div>\n", classes, value, rows);
}

std::string html_tiles(const std::string& tiles) {
  return tiles.empty() ? tiles : "<div class=\"tiles\">\n" + tiles + "</div>\n";
}

std::string html_figure(const std::string& image, const std::string& caption) {
  return "<figure>" + image + "<figcaption>" + caption + "</figcaption></figure>\n";
}

std::string html_wide_figure(const std::string& image, const std::string& caption) {
  return html_figure("<div class=\"sideways\">" + image + "</div>", caption);
}

std::string html_chart(const std::string& name, const std::string& image, const std::string& caption) {
  return fmt::format(
      "<figure class=\"chart\" data-chart=\"{}\"><div class=\"live\" hidden></div><div "
      "class=\"still\">{}</div><figcaption>{}"
      "</figcaption></figure>\n",
      name, image, caption);
}

std::string inline_svg(const std::string& svg, const std::string& name) {
  const std::size_t begin = svg.find("<svg");
  if (begin == std::string::npos) return {};
  std::string element = svg.substr(begin);
  // The first title would show as a tooltip that reads "Gnuplot".
  if (const std::size_t title = element.find("<title>Gnuplot</title>"); title != std::string::npos)
    element.erase(title, std::string_view("<title>Gnuplot</title>").size());
  for (const char* id : {"gpDot", "gpPt", "textstrings", "gnuplot_plot_", "gnuplot_canvas"}) {
    replace_all(element, fmt::format("id=\"{}", id), fmt::format("id=\"{}_{}", name, id));
    replace_all(element, fmt::format("id='{}", id), fmt::format("id='{}_{}", name, id));
    replace_all(element, fmt::format("href='#{}", id), fmt::format("href='#{}_{}", name, id));
    replace_all(element, fmt::format("url(#{}", id), fmt::format("url(#{}_{}", name, id));
  }
  replace_all(element, "=\"black\"", "=\"var(--ink)\"");  // what no script gave a colour
  replace_all(element, "font-family=\"Helvetica\"", "font-family=\"system-ui,Helvetica Neue,Arial,sans-serif\"");
  return themed(element);
}

std::string html_page(const std::string& title, const std::string& content) {
  return "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\">\n"
         "<meta name=\"viewport\" content=\"width=device-width,initial-scale=1\">\n<title>" +
         html_escaped(title) + " · Splashdown</title>\n<style>" + theme_style() + std::string(style) +
         "</style></head>\n<body><main>\n" + content + "</main></body></html>\n";
}

}  // namespace splashdown::apps
