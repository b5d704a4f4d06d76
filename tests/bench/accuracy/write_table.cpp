#include "write_table.hpp"

namespace bench {
namespace {

std::string text(const char *format, double value) {
  char buffer[64];
  std::snprintf(buffer, sizeof buffer, format, value);
  return buffer;
}

// Of a figure of which less is better; a dash where the sizes differ.
std::string ratio(double ours, double theirs, bool comparable) {
  return comparable && theirs > 0 ? text("%.2f", ours / theirs) : "";
}

void write_row(std::FILE *to, const Sweep &sweep, const Entry &entry, const Entry *peer) {
  const Quality &q = entry.quality;
  const bool comparable = peer && peer != &entry && is_comparable(entry, *peer);
  const Entry &base = peer ? *peer : entry;
  const std::string cells[] = {sweep.set,
                               entry.method,
                               text("%.2f", 100 * double(entry.tets) / double(sweep.tets)),
                               text("%.3f", 100 * q.field.rms),
                               text("%.3f", 100 * q.field.rms_inner),
                               text("%.2f", 100 * q.field.max),
                               text("%.1f", 100 * q.field.outside),
                               text("%.4f", q.hausdorff),
                               text("%.1f", 100 * q.volume),
                               q.valid ? "yes" : "no",
                               text("%.3f", entry.cpu.median),
                               text("%.3f", entry.wall.median),
                               ratio(q.field.rms, base.quality.field.rms, comparable),
                               ratio(q.field.rms_inner, base.quality.field.rms_inner, comparable),
                               ratio(q.field.max, base.quality.field.max, comparable),
                               ratio(q.hausdorff, base.quality.hausdorff, comparable),
                               ratio(entry.cpu.median, base.cpu.median, comparable),
                               ratio(entry.wall.median, base.wall.median, comparable)};
  std::fputc('|', to);
  for (const std::string &cell : cells) std::fprintf(to, " %s |", cell.c_str());
  std::fputc('\n', to);
}

}  // namespace

void write_table_head(std::FILE *to) {
  std::fputs(
      "| set | method | tets kept, % | RMS at vertices, % | RMS between, % | max, % | outside, % | Hausdorff | volume, "
      "% "
      "| valid | CPU s | wall s | RMS, of the peer's | between | max | Hausdorff | CPU s | wall s |\n"
      "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n",
      to);
}

void write_table(std::FILE *to, const Sweep &sweep) {
  for (const SizeRow &row : sweep.rows) {
    for (const Entry &entry : row.entries) write_row(to, sweep, entry, peer_of(row));
  }
  std::fflush(to);
}

}  // namespace bench
