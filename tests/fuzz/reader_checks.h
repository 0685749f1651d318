// What must hold of anything that a reader accepted. All \throw std::logic_error if it does not.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace tacipc {

/// read_triangle_mesh: finite positions, indices of vertices that there are.
void check_triangle_mesh(const std::filesystem::path& file);
/// read_scene_file: glTF and 3MF.
void check_scene(const std::filesystem::path& file);
/// The files of a ZIP archive in a new one that is whole, as they lie there: those that were stored are read.
std::string zip_made_whole(std::string_view bytes);
/// read_msh, and read_tet_mesh where that accepts the file too.
void check_tet_mesh(const std::filesystem::path& file);

/// ConfigReader, every key in every way; what it says, written out again, says the same.
void check_yaml(const std::filesystem::path& file);
/// ConfigText: a value of the file changed, taken out and added to.
void check_edits(const std::filesystem::path& file);
void check_sensor(const std::filesystem::path& file);
void check_motion(const std::filesystem::path& file);
/// ObjectSpec and DatasetMaps.
void check_object(const std::filesystem::path& file);
/// Record, every key in every way.
void check_record(const std::filesystem::path& file);

/// read_npy and NpyFrames, which must agree.
void check_npy(const std::filesystem::path& file);
/// CsvReader; rows written by csv_line.
void check_csv(const std::filesystem::path& file);
void check_plan(const std::filesystem::path& file);
void check_path(const std::filesystem::path& file);

/// read_png, which reads JPEG too, in colour and grey.
void check_image(const std::filesystem::path& file);
void check_exr(const std::filesystem::path& file);
/// The chunks of a PNG with the checksums that they should have.
std::string png_with_checksums(std::string_view bytes);

}  // namespace tacipc
