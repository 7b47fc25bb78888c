#include "plugin/SharedObject.h"

#include <cstring>
#include <elf.h>
#include <string>
#include <sys/stat.h>

#include <gtest/gtest.h>

#include "ScratchFolder.h"
#include "plugin/Module.h"

namespace teren {
namespace {

const std::filesystem::path kGoodModule =
    std::filesystem::path(TEREN_TEST_MODULES) / "good" / "teren-flat.so";

TEST(SharedObject, AcceptsAGoodModule) {
  EXPECT_TRUE(checkSharedObject(kGoodModule).ok());
}

TEST(SharedObject, RefusesAGoodModuleCutAnywhere) {
  const ScratchFolder folder;
  const std::string whole = fileBytes(kGoodModule);
  ASSERT_GT(whole.size(), 4096U);
  const std::size_t step = whole.size() / 97;
  for (std::size_t size = 0; size < whole.size(); size += step) {
    folder.write("teren-flat.so", whole.substr(0, size));
    EXPECT_FALSE(openModule(folder / "teren-flat.so", ModuleLoading::mapped).ok())
        << size << " of " << whole.size() << " bytes";
  }
  folder.write("teren-flat.so", whole.substr(0, whole.size() - 1));
  EXPECT_FALSE(openModule(folder / "teren-flat.so", ModuleLoading::mapped).ok());
}

TEST(SharedObject, SaysWhyAFileIsNotAModule) {
  const ScratchFolder folder;
  const auto refusal = [&](const std::string& bytes) {
    folder.write("file", bytes);
    const Result<void> checked = checkSharedObject(folder / "file");
    return checked ? std::string() : checked.error().message;
  };
  EXPECT_EQ(refusal(""), "it is empty");
  EXPECT_EQ(refusal("x"), "it is not a shared library (no ELF file)");
  EXPECT_EQ(refusal(std::string(100'000, 'x')), "it is not a shared library (no ELF file)");
  EXPECT_EQ(refusal("\x7f"
                    "EL"),
            "it is cut short: its headers speak of more than the file holds");
}

TEST(SharedObject, RefusesHeadersThatPointOutsideTheFile) {
  const ScratchFolder folder;
  const std::string whole = fileBytes(kGoodModule);
  const auto refusedWith = [&](auto change) {
    std::string bytes = whole;
    Elf64_Ehdr header{};
    std::memcpy(&header, bytes.data(), sizeof(header));
    change(header);
    std::memcpy(bytes.data(), &header, sizeof(header));
    folder.write("file", bytes);
    return !checkSharedObject(folder / "file").ok();
  };
  EXPECT_FALSE(refusedWith([](Elf64_Ehdr&) {}));
  EXPECT_TRUE(refusedWith([](Elf64_Ehdr& header) { header.e_phoff = ~std::uint64_t{0} - 8; }));
  EXPECT_TRUE(refusedWith([](Elf64_Ehdr& header) { header.e_phnum = 65535; }));
  EXPECT_TRUE(refusedWith([](Elf64_Ehdr& header) { header.e_shoff = ~std::uint64_t{0}; }));
  EXPECT_TRUE(refusedWith([](Elf64_Ehdr& header) { header.e_machine = EM_68K; }));
  EXPECT_TRUE(refusedWith([](Elf64_Ehdr& header) { header.e_type = ET_REL; }));
  EXPECT_TRUE(refusedWith([](Elf64_Ehdr& header) { header.e_phentsize = 1; }));
  EXPECT_TRUE(refusedWith([](Elf64_Ehdr& header) { header.e_ident[EI_CLASS] = ELFCLASS32; }));
}

TEST(SharedObject, RefusesFoldersPipesAndDevicesWithoutWaiting) {
  const ScratchFolder folder;
  std::filesystem::create_directory(folder / "folder");
  ASSERT_EQ(mkfifo((folder / "pipe").c_str(), 0600), 0);
  EXPECT_EQ(checkSharedObject(folder / "folder").error().message, "it is not a regular file");
  EXPECT_EQ(checkSharedObject(folder / "pipe").error().message, "it is not a regular file");
  EXPECT_EQ(checkSharedObject("/dev/zero").error().message, "it is not a regular file");
  EXPECT_EQ(checkSharedObject(folder / "absent").error().message, "it is not a regular file");
}

}  // namespace
}  // namespace teren
