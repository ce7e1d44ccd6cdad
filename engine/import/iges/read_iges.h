#pragma once

#include <string>
#include <string_view>

#include "engine/import/import_result.h"

namespace lamina::engine {

/// Whether the bytes start like an IGES file: column 73 of the first line holds the letter of a section.
bool looks_like_iges(std::string_view bytes);

/// Reads an IGES 5.3 file in fixed format. `name` is the file's name in messages and in the model.
///
/// Every surface, face or solid that stands for itself (visible, not part of another entity, of geometry use)
/// becomes NURBS surfaces in mm, clamped, in the order of the directory, with the trim loops of its faces.
/// Arcs, conics, B-splines and surfaces made of them are exact, parametric splines too; offsets are
/// approximated within 1e-5 of their size, and the report says how closely. Trim curves are those of the
/// parameter plane, or the ones in space, projected, where there are no others or these differ; they are good
/// to 1e-5 of the face's size or better (to the file's resolution where that is finer, but not below 1e-7).
/// Rails of a ruled surface are joined at equal NURBS parameter; where the file asks for equal arc length
/// (form 0) and that is not the same, the report says how far the rails are shifted against each other.
///
/// Common breaches of the format are read and reported (see Tolerance). Everything else that is wrong, and a
/// file without any surface to slice, throws ImportError. Nothing in the file is trusted: memory stays below
/// some 40 times the size of the file, time is bounded by it too.
ImportResult read_iges(std::string_view bytes, const std::string& name);

}  // namespace lamina::engine
