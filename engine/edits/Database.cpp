#include "edits/Database.h"

namespace teren {

namespace {

constexpr int kPatience = 2000;  // [ms] with another program's lock

/// A file's name as part of SQLite's own kind of address.
std::string asAddress(const std::string& name) {
  constexpr std::string_view kDigits = "0123456789ABCDEF";
  std::string address;
  for (const char c : name) {
    const auto byte = static_cast<unsigned char>(c);
    if (c == '%' || c == '?' || c == '#' || byte < 0x20 || byte > 0x7E) {
      address += {'%', kDigits[byte >> 4U], kDigits[byte & 15U]};
    } else {
      address += c;
    }
  }
  return address;
}

}  // namespace

Result<bool> Statement::step() {
  const int answer = sqlite3_step(statement_.get());
  if (answer == SQLITE_ROW) return true;
  if (answer == SQLITE_DONE) return false;
  return Error{sqlite3_errmsg(sqlite3_db_handle(statement_.get()))};
}

std::string_view Statement::text(int column) const {
  const auto* const text = reinterpret_cast<const char*>(sqlite3_column_text(statement_.get(), column));
  if (text == nullptr) return {};
  return {text, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

std::string_view Statement::bytes(int column) const {
  const auto* const bytes = static_cast<const char*>(sqlite3_column_blob(statement_.get(), column));
  if (bytes == nullptr) return {};
  return {bytes, static_cast<std::size_t>(sqlite3_column_bytes(statement_.get(), column))};
}

Result<Database> Database::open(const std::filesystem::path& file, bool create) {
  // An absolute name cannot be taken for one of SQLite's special ones.
  return openAt(std::filesystem::absolute(file).string(),
                SQLITE_OPEN_READWRITE | (create ? SQLITE_OPEN_CREATE : 0));
}

Result<Database> Database::openUnchanging(const std::filesystem::path& file) {
  const std::string address = "file:" + asAddress(std::filesystem::absolute(file).string()) + "?immutable=1";
  return openAt(address, SQLITE_OPEN_READONLY | SQLITE_OPEN_URI);
}

Result<Database> Database::openAt(const std::string& name, int flags) {
  sqlite3* connection = nullptr;
  const int answer = sqlite3_open_v2(name.c_str(), &connection, flags | SQLITE_OPEN_NOMUTEX, nullptr);
  Database database(connection);
  if (answer != SQLITE_OK)
    return Error{connection == nullptr ? "there is not enough memory" : sqlite3_errmsg(connection)};
  sqlite3_busy_timeout(connection, kPatience);
  sqlite3_limit(connection, SQLITE_LIMIT_LENGTH, kMostValueBytes);
  sqlite3_db_config(connection, SQLITE_DBCONFIG_DEFENSIVE, 1, nullptr);
  sqlite3_db_config(connection, SQLITE_DBCONFIG_TRUSTED_SCHEMA, 0, nullptr);
  sqlite3_db_config(connection, SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 1, nullptr);
  return database;
}

void Database::tidyUp() {
  sqlite3_db_config(connection_.get(), SQLITE_DBCONFIG_NO_CKPT_ON_CLOSE, 0, nullptr);
}

Result<void> Database::execute(const char* statements) {
  if (sqlite3_exec(connection_.get(), statements, nullptr, nullptr, nullptr) != SQLITE_OK) return error();
  return {};
}

Result<Statement> Database::prepare(std::string_view statement) {
  sqlite3_stmt* prepared = nullptr;
  const int answer = sqlite3_prepare_v2(connection_.get(), statement.data(),
                                        static_cast<int>(statement.size()), &prepared, nullptr);
  if (answer != SQLITE_OK) return error();
  return Statement(prepared);
}

Result<std::int64_t> Database::number(std::string_view statement) {
  Result<Statement> prepared = prepare(statement);
  if (!prepared) return prepared.error();
  const Result<bool> row = prepared->step();
  if (!row) return row.error();
  if (!*row) return Error{"there is no answer"};
  return prepared->whole(0);
}

}  // namespace teren
