/// The group /table1 of MAPS.h5: one row per line of the atlas, its parameters, regions and triggers.
#pragma once

#include <cstddef>
#include <string>
#include <vector>

#include "analysis/findings.hpp"
#include "atlas/hdf5.hpp"

namespace rubatlas::analysis {

/// The column of a table that holds values of an axis of the atlas. It is not named like the axis itself,
/// which xarray would put in its place.
std::string column_of(const plan::Axis& axis);

/// Texts along a scale.
void create_texts(atlas::File& file, const std::string& path, const atlas::Dataset& scale,
                  const std::string& long_name, const std::vector<std::string>& texts);

/// A dimension scale that numbers its entries from 0. `name` is that of the dimension.
atlas::Dataset create_number_scale(atlas::File& file, const std::string& path, const std::string& name,
                                   std::size_t size, const std::string& long_name);

/// Describes the codes of motions, in a dataset of classes.
void set_class_flags(atlas::Dataset& dataset);

/// The attributes `relative_tolerance` and `absolute_tolerance`: so many closing tolerances.
void set_tolerance(atlas::Dataset& dataset, const Findings& found, double factor);

/// Creates the group with all its columns.
void create_table(atlas::File& file, const Findings& found);

}  // namespace rubatlas::analysis
