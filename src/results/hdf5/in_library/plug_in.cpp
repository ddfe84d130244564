// Entry point of librailstrata-hdf5.so, beside the room.
#include "hdf5/plug_in.hpp"

const railstrata::Hdf5PlugIn railstrata_hdf5_plug_in{&railstrata::checkpoint_image, &railstrata::checkpoint_of_image,
                                                     &railstrata::give_memory_back, &railstrata::table_image,
                                                     &railstrata::table_in_file};
