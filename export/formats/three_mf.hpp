#pragma once
// Names inside a 3MF package, shared by its writer and its reader.

#include <string_view>

namespace clay::solid::inline formats::three_mf {

// The only path that every slicer finds.
inline constexpr std::string_view kModelPath = "3D/3dmodel.model";
inline constexpr std::string_view kTypesPath = "[Content_Types].xml";
inline constexpr std::string_view kRelationsPath = "_rels/.rels";
// Found by its relationship. The usual name, thumbnail.png, makes assimp 5.2 free memory twice.
inline constexpr std::string_view kThumbnailPath = "Metadata/thumb.png";
// Settings of objects for PrusaSlicer; `notes` is the only one. In its projects it also names the
// kinds of volumes.
inline constexpr std::string_view kNotesPath = "Metadata/Slic3r_PE_model.config";
// The same of Bambu Studio and OrcaSlicer.
inline constexpr std::string_view kSettingsPath = "Metadata/model_settings.config";
inline constexpr std::string_view kPotNote = "claystack:pot:";
inline constexpr std::string_view kPotPath = "Metadata/claystack.pot.cbor";
inline constexpr std::string_view kCertificatePath = "Metadata/claystack.certificate.json";

inline constexpr std::string_view kCore =
    "http://schemas.microsoft.com/3dmanufacturing/core/2015/02";
inline constexpr std::string_view kMaterials =
    "http://schemas.microsoft.com/3dmanufacturing/material/2015/02";
inline constexpr std::string_view kModelRelation =
    "http://schemas.microsoft.com/3dmanufacturing/2013/01/3dmodel";
inline constexpr std::string_view kThumbnailRelation =
    "http://schemas.openxmlformats.org/package/2006/relationships/metadata/thumbnail";
inline constexpr std::string_view kModelType =
    "application/vnd.ms-package.3dmanufacturing-3dmodel+xml";
inline constexpr std::string_view kRelationType =
    "application/vnd.openxmlformats-package.relationships+xml";
inline constexpr std::string_view kTypes =
    "http://schemas.openxmlformats.org/package/2006/content-types";
inline constexpr std::string_view kRelations =
    "http://schemas.openxmlformats.org/package/2006/relationships";

/// The namespace and prefix of Claystack's metadata. `claystack:pot` is a copy of the pot.
inline constexpr std::string_view kOwn = "https://claystack.org/3mf/1";
inline constexpr std::string_view kPotMetadata = "claystack:pot";
inline constexpr std::string_view kOwnPrefix = "claystack:";

/// The largest pot that is also copied into the metadata: readers of XML limit a text.
inline constexpr std::size_t kMostCopiedPotBytes = 4'000'000;

}  // namespace clay::solid::inline formats::three_mf
