#include "html_report.hpp"

#include <cstdint>
#include <cstdio>
#include <filesystem>

#include "scale.hpp"

namespace cli {
namespace {

constexpr char kStyle[] = R"(
:root{color-scheme:light dark;--paper:#fff;--ink:#1f2126;--soft:#5c6068;--line:#d5d7db;--box:#f4f5f6}
@media(prefers-color-scheme:dark){:root{--paper:#171a1f;--ink:#e6e8eb;--soft:#a3a8b0;--line:#3a3f47;--box:#20242a}}
body{background:var(--paper);color:var(--ink);font:16px/1.5 system-ui,sans-serif;max-width:1480px;margin:0 auto;padding:24px}
h1{font-size:26px;margin:0 0 4px}h2{font-size:20px;margin:36px 0 8px}p{max-width:85ch}
.soft,figcaption{color:var(--soft)}figure{margin:0}img{max-width:100%;height:auto;display:block}figcaption{max-width:100ch}
.tables{display:flex;flex-wrap:wrap;gap:8px 48px;align-items:flex-start}
table{border-collapse:collapse}caption{text-align:left;font-weight:600;padding:12px 0 4px}
th,td{padding:3px 14px 3px 0;border-top:1px solid var(--line);text-align:left;font-weight:400}td{text-align:right;padding:3px 0 3px 14px;white-space:nowrap}
td,.number{font-variant-numeric:tabular-nums}pre{background:var(--box);padding:12px;overflow-x:auto;white-space:pre-wrap;word-break:break-word}
)";

std::string escaped(const std::string &text) {
  std::string out;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '"')
      out += "&quot;";
    else
      out += c;
  }
  return out;
}

std::string base64(const std::string &bytes) {
  constexpr char digits[] = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  out.reserve(bytes.size() / 3 * 4 + 4);
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    const std::size_t left = bytes.size() - i;
    std::uint32_t bits = 0;
    for (std::size_t k = 0; k < 3; k++) bits = bits << 8 | (k < left ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; k++) out += k <= left ? digits[bits >> (18 - 6 * k) & 63U] : '=';
  }
  return out;
}

template <class... Values>
std::string formatted(const char *format, Values... values) {
  char text[128];
  std::snprintf(text, sizeof text, format, values...);
  return text;
}

std::string percent(double share) { return formatted("%.3g", 100 * share) + " %"; }
std::string share_of(int64_t part, int64_t whole) { return whole > 0 ? percent(double(part) / double(whole)) : "-"; }
std::string seconds_text(double seconds) { return formatted("%.3f s", seconds); }
std::string megabytes(uint64_t bytes) { return formatted("%.1f MB", double(bytes) / 1e6); }

class Table {
 public:
  Table(const std::string &title, const std::string &before = "", const std::string &after = "")
      : text_("<table><caption>" + title + "</caption>") {
    if (!before.empty()) text_ += "<tr><th></th><td>" + before + "</td><td>" + after + "</td><td></td></tr>";
  }
  void row(const std::string &name, const std::string &value) {
    text_ += "<tr><th>" + name + "</th><td>" + value + "</td></tr>";
  }
  void row(const std::string &name, int64_t before, int64_t after) {
    text_ += "<tr><th>" + name + "</th><td>" + count_text(before) + "</td><td>" + count_text(after) + "</td><td>" +
             share_of(after, before) + "</td></tr>";
  }
  std::string text() const { return text_ + "</table>\n"; }

 private:
  std::string text_;
};

std::string counts_table(const tetlod_run_report &run) {
  Table table("Mesh", "original", "simplified");
  table.row("tets", run.tets_in, run.tets_out);
  table.row("vertices", run.points_in, run.points_out);
  table.row("boundary triangles", run.boundary_triangles_in, run.boundary_triangles_out);
  table.row("boundary edges", run.boundary_edges_in, run.boundary_edges_out);
  table.row("boundary vertices", run.boundary_points_in, run.boundary_points_out);
  return table.text();
}

std::string samples_table(const tetlod_run_report &run) {
  Table table("Vertices inside");
  table.row("samples of the original's", count_text(run.selected_samples));
  table.row("removed: outside", count_text(run.samples_outside));
  table.row("removed: too near the boundary", count_text(run.samples_too_near));
  table.row("added by the tetrahedralization (Steiner points)", count_text(run.steiner_points));
  if (run.inserted_points > 0) table.row("inserted for the error's sake", count_text(run.inserted_points));
  if (run.merged_points > 0) table.row("coincident points merged", count_text(run.merged_points));
  if (run.dropped_tets > 0) table.row("tets dropped", count_text(run.dropped_tets));
  if (run.divided_tets > 0) table.row("tets divided", count_text(run.divided_tets));
  if (run.moved_points > 0) table.row("points moved", count_text(run.moved_points));
  if (run.nonfinite_points > 0) table.row("points without a value", count_text(run.nonfinite_points));
  table.row("boundary components, kept", count_text(run.components));
  return table.text();
}

std::string error_table(const tetlod_error_report &error) {
  Table table("Error of the field, of its range");
  table.row("root mean square, at the vertices", percent(error.rms));
  table.row("maximum there", percent(error.max));
  table.row("vertices outside, not counted", percent(error.outside));
  table.row("root mean square, inside the tets", percent(error.rms_inner));
  table.row("maximum there", percent(error.max_inner));
  return table.text();
}

std::string seconds_table(const tetlod_run_report &run, const ToolSeconds &tool) {
  Table table("Time, " + std::to_string(run.threads) + (run.threads == 1 ? " thread" : " threads"));
  table.row("reading", seconds_text(tool.reading));
  table.row("preparing", seconds_text(run.seconds_prepare));
  table.row("extracting the boundary", seconds_text(run.seconds_boundary));
  table.row("simplifying the boundary", seconds_text(run.seconds_decimate));
  table.row("sampling points", seconds_text(run.seconds_sample));
  table.row("removing samples", seconds_text(run.seconds_cull));
  table.row("tetrahedralization", seconds_text(run.seconds_remesh));
  table.row("values", seconds_text(run.seconds_values));
  table.row("<b>simplification</b>", "<b>" + seconds_text(run.seconds_total) + "</b>");
  table.row("measuring the error", seconds_text(tool.measuring));
  table.row("writing", seconds_text(tool.writing));
  table.row("pictures", seconds_text(tool.pictures));
  table.row("memory, at most", megabytes(run.peak_bytes));
  table.row("and in tetlod-remesh", megabytes(run.worker_peak_bytes));
  return table.text();
}

std::string lead(const std::string &field, const tetlod_run_report &run, const tetlod_error_report &error) {
  const Scale range{run.scalar_min, run.scalar_max};
  return "<p>" + count_text(run.tets_in) + " tets became <b>" + count_text(run.tets_out) + "</b>, " +
         share_of(run.tets_out, run.tets_in) + ", in " + formatted("%.3g", run.seconds_total) +
         " s. At the original's vertices the field <b>" + escaped(field) + "</b> is off by <b>" + percent(error.rms) +
         "</b> of its range (root mean square), at most by " + percent(error.max) + "; " + percent(error.outside) +
         " of the vertices lie outside of the simplified mesh and are not counted. Its range is " +
         number_text(run.scalar_min, range) + " to " + number_text(run.scalar_max, range) + ".</p>\n";
}

std::string figure_text(const DrawnFigure &figure) {
  const std::string begin = "data:image/png;base64,", width = std::to_string(figure.width);
  return "<h2>" + figure.title + "</h2>\n<figure><picture><source media=\"(prefers-color-scheme: dark)\" srcset=\"" +
         begin + base64(figure.dark) + "\"><img width=\"" + width + "\" alt=\"" +
         escaped(figure.title + ": " + figure.caption) + "\" src=\"" + begin + base64(figure.light) +
         "\"></picture>\n<figcaption>" + escaped(figure.caption) + "</figcaption></figure>\n";
}

}  // namespace

std::string html_report(const Arguments &arguments, const std::string &field, const vtkTetlodSimplify &filter,
                        const ToolSeconds &seconds, const std::vector<DrawnFigure> &figures) {
  const tetlod_run_report run = run_report(filter.GetContext());
  const tetlod_error_report &error = filter.GetErrorReport();
  const std::string name = escaped(std::filesystem::path(arguments.input).filename().string());
  std::string page = "<!DOCTYPE html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>tetlod: " + name +
                     "</title>\n<meta name=\"viewport\" content=\"width=device-width\"><style>" + kStyle +
                     "</style></head><body>\n<h1>" + name + ", simplified</h1>\n" + lead(field, run, error);
  for (const DrawnFigure &figure : figures) page += figure_text(figure);
  page += "<h2>In numbers</h2>\n<div class=\"tables\">" + counts_table(run) + samples_table(run) + error_table(error) +
          seconds_table(run, seconds) + "</div>\n<h2>Made by</h2>\n<pre>" + escaped(arguments.command) +
          "</pre>\n<p class=\"soft\">" + escaped(tetlod_build_info()) + "</p>\n</body></html>\n";
  return page;
}

}  // namespace cli
