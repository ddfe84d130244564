#pragma once
// System calls of output_file. After a failure errno has the reason.
#include <cstddef>
#include <filesystem>
#include <string_view>

namespace railstrata::disk {

/// Opens a file for writing, made or emptied; programs started from here do not have it. Negative if that fails.
int create(const std::filesystem::path& file);
/// Bytes written, perhaps not all; negative if that fails.
std::ptrdiff_t write(int descriptor, std::string_view bytes);
/// Takes so many bytes away from the end, if that is possible.
void cut_back(int descriptor, std::ptrdiff_t bytes);
/// Waits until the disk has the file; true also of what is on no disk.
bool sync(int descriptor);
bool close(int descriptor);
/// Waits until the disk has the names in the folder of the file, where that can be asked for.
void sync_folder_of(const std::filesystem::path& file);

}  // namespace railstrata::disk
