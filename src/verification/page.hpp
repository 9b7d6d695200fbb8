#pragma once
/// A report of headings, paragraphs, tables and pictures, as Markdown and as one self-contained HTML file.

#include <filesystem>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace spindrift {

class Page {
 public:
  using Row = std::vector<std::string>;

  /// Texts are plain, but for `code` between backticks and *emphasis* between asterisks.
  void heading(int level, std::string text) { blocks_.emplace_back(Heading{level, std::move(text)}); }
  void paragraph(std::string text) { blocks_.emplace_back(Paragraph{std::move(text)}); }
  void item(std::string text) { blocks_.emplace_back(Item{std::move(text)}); }
  void table(Row head, std::vector<Row> rows) { blocks_.emplace_back(Table{std::move(head), std::move(rows)}); }
  /// file: a PNG, seen from the page's folder
  void picture(std::string file, std::string caption) {
    blocks_.emplace_back(Picture{std::move(file), std::move(caption)});
  }

  std::string markdown() const;
  /// With the pictures inside, read from `folder`; one that is not there is left out.
  std::string html(std::string_view title, const std::filesystem::path& folder) const;

 private:
  struct Heading {
    int level;
    std::string text;
  };
  struct Paragraph {
    std::string text;
  };
  struct Item {
    std::string text;
  };
  struct Table {
    Row head;
    std::vector<Row> rows;
  };
  struct Picture {
    std::string file, caption;
  };
  using Block = std::variant<Heading, Paragraph, Item, Table, Picture>;

  static std::string markdown_of(const Block& block);
  static std::string html_of(const Block& block, const std::filesystem::path& folder);

  std::vector<Block> blocks_;
};

}  // namespace spindrift
