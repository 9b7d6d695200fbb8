#include "verification/page.hpp"

#include <fmt/format.h>

#include <cstdint>
#include <fstream>
#include <iterator>

namespace spindrift {
namespace {

std::string joined(const Page::Row& cells, std::string_view before, std::string_view after) {
  std::string text;
  for (const std::string& cell : cells) text += fmt::format("{}{}{}", before, cell, after);
  return text;
}

/// A bar would end the cell.
Page::Row without_bars(Page::Row cells) {
  for (std::string& cell : cells)
    for (std::size_t at = 0; (at = cell.find('|', at)) != std::string::npos; at += 2) cell.insert(at, 1, '\\');
  return cells;
}

/// Of HTML, with backticks as <code> and asterisks as <em>.
std::string marked_up(std::string_view text) {
  std::string out;
  bool code = false, emphasis = false;
  for (const char c : text) {
    if (c == '&')
      out += "&amp;";
    else if (c == '<')
      out += "&lt;";
    else if (c == '>')
      out += "&gt;";
    else if (c == '`')
      out += (code = !code) ? "<code>" : "</code>";
    else if (c == '*' && !code)
      out += (emphasis = !emphasis) ? "<em>" : "</em>";
    else
      out += c;
  }
  return out;
}

std::string base64(std::string_view bytes) {
  constexpr std::string_view digits = "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  std::string out;
  for (std::size_t i = 0; i < bytes.size(); i += 3) {
    std::uint32_t three = 0;
    for (std::size_t k = 0; k < 3; ++k)
      three = three << 8 | (i + k < bytes.size() ? static_cast<unsigned char>(bytes[i + k]) : 0U);
    for (std::size_t k = 0; k < 4; ++k) out += i + k <= bytes.size() ? digits[three >> (18 - 6 * k) & 63] : '=';
  }
  return out;
}

constexpr std::string_view style =
    "body{font:16px/1.5 system-ui,sans-serif;max-width:70rem;margin:2rem auto;padding:0 1rem;color:#1c2733}"
    "table{border-collapse:collapse;font-size:.85rem;margin:1rem 0}td,th{border:1px solid #cfd8e0;padding:.2rem .5rem;"
    "text-align:left;vertical-align:top}th{background:#eef3f7}code{background:#f0f3f5;padding:0 .2rem}"
    "img{max-width:100%}";

}  // namespace

std::string Page::markdown() const {
  std::string text;
  bool in_list = false;
  for (const Block& block : blocks_) {
    const bool item = std::holds_alternative<Item>(block);
    if (!text.empty() && !(in_list && item)) text += "\n";
    text += markdown_of(block);
    in_list = item;
  }
  return text;
}

std::string Page::markdown_of(const Block& block) {
  if (const auto* heading = std::get_if<Heading>(&block))
    return fmt::format("{} {}\n", std::string(static_cast<std::size_t>(heading->level), '#'), heading->text);
  if (const auto* paragraph = std::get_if<Paragraph>(&block)) return paragraph->text + "\n";
  if (const auto* item = std::get_if<Item>(&block)) return fmt::format("- {}\n", item->text);
  if (const auto* picture = std::get_if<Picture>(&block))
    return fmt::format("![{}]({})\n", picture->caption, picture->file);
  const auto& table = std::get<Table>(block);
  std::string text = joined(table.head, "| ", " ") + "|\n" + joined(Row(table.head.size(), "---"), "| ", " ") + "|\n";
  for (const Row& row : table.rows) text += joined(without_bars(row), "| ", " ") + "|\n";
  return text;
}

std::string Page::html(std::string_view title, const std::filesystem::path& folder) const {
  std::string text = fmt::format(
      "<!doctype html>\n<html lang=\"en\"><head><meta charset=\"utf-8\"><title>{}</title><style>{}</style></head>"
      "<body>\n",
      marked_up(title), style);
  bool in_list = false;
  for (const Block& block : blocks_) {
    const bool item = std::holds_alternative<Item>(block);
    if (item != in_list) text += item ? "<ul>\n" : "</ul>\n";
    text += html_of(block, folder);
    in_list = item;
  }
  return text + (in_list ? "</ul>\n" : "") + "</body></html>\n";
}

std::string Page::html_of(const Block& block, const std::filesystem::path& folder) {
  if (const auto* heading = std::get_if<Heading>(&block))
    return fmt::format("<h{0}>{1}</h{0}>\n", heading->level, marked_up(heading->text));
  if (const auto* paragraph = std::get_if<Paragraph>(&block))
    return fmt::format("<p>{}</p>\n", marked_up(paragraph->text));
  if (const auto* item = std::get_if<Item>(&block)) return fmt::format("<li>{}</li>\n", marked_up(item->text));
  if (const auto* picture = std::get_if<Picture>(&block)) {
    std::ifstream file(folder / picture->file, std::ios::binary);
    if (!file) return "";
    const std::string bytes((std::istreambuf_iterator<char>(file)), {});
    return fmt::format("<p><img alt=\"{}\" src=\"data:image/png;base64,{}\"></p>\n", marked_up(picture->caption),
                       base64(bytes));
  }
  const auto& table = std::get<Table>(block);
  const auto cells = [](const Row& row, std::string_view tag) {
    std::string text = "<tr>";
    for (const std::string& cell : row) text += fmt::format("<{0}>{1}</{0}>", tag, marked_up(cell));
    return text + "</tr>\n";
  };
  std::string text = "<table>\n" + cells(table.head, "th");
  for (const Row& row : table.rows) text += cells(row, "td");
  return text + "</table>\n";
}

}  // namespace spindrift
