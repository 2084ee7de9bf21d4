#pragma once

#include <hdf5.h>

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>

/// The seal of a part of an HDF5 file: a text dataset with a checksum of every object of that part. It covers names,
/// kinds, shapes, types, attributes and values, so a reader of the part can name the altered object.
namespace vehd {

/// Checksum of each object by its path: the sum modulo 2³² of the checksums of its content and of its attributes, whose
/// order therefore does not matter.
using ObjectChecksums = std::map<std::string, std::uint32_t>;

/// Kinds of content that a checksum distinguishes.
enum class ContentKind : char { group = 'g', numbers = 'd', integers = 'i', text = 's', other = 'o' };

/// Checksum of the content of a group or a dataset.
/// @param extents  extent of each dimension; empty for a group or a text
/// @param bytes    values in the order of the file, as this machine stores them
std::uint32_t content_checksum(ContentKind kind, std::span<const hsize_t> extents, std::string_view bytes);

/// Checksum of an attribute that is one number or one text.
std::uint32_t attribute_checksum(std::string_view name, ContentKind kind, std::string_view bytes);

/// Path of the seal of a group, or of the header of the file: "/".
std::string seal_path(const std::string& group);

/// The text of a seal: one line "CHECKSUM PATH" for each object, in the order of paths.
std::string seal_text(const ObjectChecksums& objects);

/// Checksum of a seal, which represents everything that the seal covers.
std::int64_t seal_checksum(const std::string& seal);

/// Differences of objects from their seal: "/a does not match its checksum, /b is missing". Empty if there are none.
std::string differences(const std::string& seal, const ObjectChecksums& objects);

}  // namespace vehd
