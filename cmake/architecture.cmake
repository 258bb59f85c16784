# Which room may include which; read by check_architecture.cmake, a test, and by draw_rooms.py, which draws them.
# Rooms of headers stand above those that they use. Headers of the compiled rooms declare what pavior::<room> defines.
set(rooms core math mesh affine smooth dual contributions marking block sweep intervals brep lattice one_to_one
    many_to_many submap decompose part tetra glpk imprint cad io)
set(compiled_rooms tetra glpk imprint cad io)
set(compiled_headers part/mesh_file.hpp part/block_reference.hpp) # the same in a room that needs Eigen alone
set(may_include_core "")
set(may_include_math core)
set(may_include_mesh core math)
set(may_include_affine core math mesh)
set(may_include_smooth core math mesh)
set(may_include_dual core math mesh)
set(may_include_contributions core math mesh dual)
set(may_include_marking core math mesh dual)
set(may_include_block core math mesh smooth dual contributions marking)
set(may_include_sweep core math mesh affine smooth)
set(may_include_intervals core)
set(may_include_brep core math mesh sweep)
set(may_include_lattice core math mesh smooth sweep brep)
set(may_include_one_to_one core math mesh sweep brep intervals lattice)
set(may_include_many_to_many core math mesh smooth sweep brep intervals)
set(may_include_submap core math mesh smooth sweep brep intervals lattice one_to_one)
set(may_include_decompose core math mesh brep intervals one_to_one many_to_many submap)
set(may_include_part core math mesh smooth dual marking block sweep brep intervals one_to_one many_to_many submap
    decompose)
set(may_include_tetra core math mesh)
set(may_include_glpk intervals)
set(may_include_imprint core math mesh many_to_many)
set(may_include_cad core math mesh brep one_to_one many_to_many decompose)
set(may_include_io core math mesh sweep contributions)

# Sources: src/<room> includes what the public room includes, that room, and these folders of src.
set(source_rooms common compiled tetra glpk imprint cad io report part cli)
set(may_include_src_common core math mesh)
set(may_include_src_compiled core math affine dual) # templates, for the types in use
set(may_include_src_tetra ${may_include_tetra} tetra src_common)
set(may_include_src_glpk core intervals glpk)
set(may_include_src_imprint ${may_include_imprint} imprint)
set(may_include_src_cad ${may_include_cad} smooth sweep cad src_common)
set(may_include_src_io ${may_include_io} io src_common)
set(may_include_src_report ${rooms})
set(may_include_src_part ${rooms} src_common src_report)
set(may_include_src_cli ${rooms} src_common src_report)

# Foreign headers, as regular expressions. Public headers know the standard library and Eigen (never all of it), with
# one exception; each source folder knows its own packages.
set(foreign_everywhere "[a-z_0-9]+"
    "Eigen/(Cholesky|Core|Eigenvalues|Geometry|Householder|LU|QR|SVD|Sparse[A-Za-z]*|Iter[A-Za-z]*|Jacobi)")
set(foreign_in_mesh/cgal_access.hpp "CGAL/.*")
set(foreign_in_core/large_array.hpp "sys/mman\\.h")
set(posix "(unistd|fcntl|poll|signal|sys/[a-z]+)\\.h")
set(foreign_in_src_common "gmsh\\.h|${posix}")
set(foreign_in_src_compiled "none")
set(foreign_in_src_tetra "tetgen\\.h|CGAL/.*|dlfcn\\.h|${posix}")
set(foreign_in_src_imprint "CGAL/.*")
set(foreign_in_src_cad "gmsh\\.h|${posix}")
set(foreign_in_src_glpk "glpk\\.h")
set(foreign_in_src_io "gmsh\\.h|vtk[A-Za-z0-9]*\\.h|nlohmann/json\\.hpp|${posix}")
set(foreign_in_src_report "nlohmann/json\\.hpp")
set(foreign_in_src_part "nlohmann/json\\.hpp|${posix}")
set(foreign_in_src_cli "CLI/.*|nlohmann/json\\.hpp|${posix}")
