#pragma once
// The room as a plug-in, librailstrata-hdf5.so: a program that only solves contacts needs no HDF5. Library and plug-in
// are of one build.
#include "hdf5/checkpoint_image.hpp"
#include "hdf5/table_image.hpp"

namespace railstrata {

/// The functions of the room.
struct Hdf5PlugIn {
  decltype(&railstrata::checkpoint_image) checkpoint_image;
  decltype(&railstrata::checkpoint_of_image) checkpoint_of_image;
  decltype(&railstrata::give_memory_back) give_memory_back;
  decltype(&railstrata::table_image) table_image;
  decltype(&railstrata::table_in_file) table_in_file;
};

}  // namespace railstrata

/// The plug-in's one symbol.
extern "C" const railstrata::Hdf5PlugIn railstrata_hdf5_plug_in;
