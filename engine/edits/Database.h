// SQLite, as far as the edit journal needs it: connections and statements that close themselves, and errors
// as sentences.
#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <sqlite3.h>
#include <string>
#include <string_view>

#include "teren/Result.h"

namespace teren {

/// A prepared statement. Numbers of parameters and columns are SQLite's: from 1 and from 0.
class Statement {
 public:
  explicit Statement(sqlite3_stmt* statement) : statement_(statement) {}

  void bind(int parameter, std::int64_t value) { sqlite3_bind_int64(statement_.get(), parameter, value); }
  /// `text` stays where it is until the next reset.
  void bind(int parameter, std::string_view text) {
    sqlite3_bind_text(statement_.get(), parameter, text.data(), static_cast<int>(text.size()), SQLITE_STATIC);
  }
  void bindBytes(int parameter, std::string_view bytes) {
    sqlite3_bind_blob(statement_.get(), parameter, bytes.data(), static_cast<int>(bytes.size()),
                      SQLITE_STATIC);
  }
  /// Whether there is another row; SQLite's words where the database refuses.
  Result<bool> step();
  void reset() { sqlite3_reset(statement_.get()); }

  std::int64_t whole(int column) const { return sqlite3_column_int64(statement_.get(), column); }
  bool isWhole(int column) const { return sqlite3_column_type(statement_.get(), column) == SQLITE_INTEGER; }
  bool isText(int column) const { return sqlite3_column_type(statement_.get(), column) == SQLITE_TEXT; }
  bool isBytes(int column) const { return sqlite3_column_type(statement_.get(), column) == SQLITE_BLOB; }
  /// Until the next step.
  std::string_view text(int column) const;
  std::string_view bytes(int column) const;

 private:
  struct Finalize {
    void operator()(sqlite3_stmt* statement) const noexcept { sqlite3_finalize(statement); }
  };
  std::unique_ptr<sqlite3_stmt, Finalize> statement_;
};

/// A connection. It trusts nothing in the file: no schema that could run functions, no value beyond
/// kMostValueBytes. Closing it leaves the file as it is, unless it was told to `tidyUp`.
class Database {
 public:
  static constexpr int kMostValueBytes = 1 << 20;

  /// For writing where the system allows it. A file that is not there is made if `create`.
  static Result<Database> open(const std::filesystem::path& file, bool create);
  /// Of a file that nobody changes, on media where nothing can be written.
  static Result<Database> openUnchanging(const std::filesystem::path& file);

  /// Statements without an answer, or whose answer nobody needs.
  Result<void> execute(const char* statements);
  Result<Statement> prepare(std::string_view statement);
  /// The one whole number that a statement answers.
  Result<std::int64_t> number(std::string_view statement);
  /// Closing brings the log into the file, and removes it.
  void tidyUp();
  /// Whether a transaction is open.
  bool inTransaction() const noexcept { return sqlite3_get_autocommit(connection_.get()) == 0; }

 private:
  struct Close {
    void operator()(sqlite3* connection) const noexcept { sqlite3_close(connection); }
  };
  explicit Database(sqlite3* connection) : connection_(connection) {}
  static Result<Database> openAt(const std::string& name, int flags);
  Error error() const { return {sqlite3_errmsg(connection_.get())}; }

  std::unique_ptr<sqlite3, Close> connection_;
};

}  // namespace teren
