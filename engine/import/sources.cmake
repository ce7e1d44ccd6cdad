# The model readers and the NURBS constructions that they need.
set(LAMINA_ENGINE_IMPORT_SOURCES
  import/breach_log.cpp
  import/gzip.cpp
  import/iges/analytic_axis.cpp
  import/iges/boundary_141.cpp
  import/iges/boundary_142.cpp
  import/iges/cubic_fit.cpp
  import/iges/curve_100.cpp
  import/iges/curve_102.cpp
  import/iges/curve_104.cpp
  import/iges/curve_106.cpp
  import/iges/curve_110.cpp
  import/iges/curve_112.cpp
  import/iges/curve_116.cpp
  import/iges/curve_126.cpp
  import/iges/curve_130.cpp
  import/iges/directory_entry.cpp
  import/iges/entity_reader.cpp
  import/iges/entity_table.cpp
  import/iges/face_510.cpp
  import/iges/global_section.cpp
  import/iges/knot_vector.cpp
  import/iges/number.cpp
  import/iges/parameter_map.cpp
  import/iges/parameter_record.cpp
  import/iges/plane_patch.cpp
  import/iges/read_iges.cpp
  import/iges/record.cpp
  import/iges/solid_186.cpp
  import/iges/spline_breaks.cpp
  import/iges/subfigure_408.cpp
  import/iges/surface_108.cpp
  import/iges/surface_114.cpp
  import/iges/surface_118.cpp
  import/iges/surface_120.cpp
  import/iges/surface_122.cpp
  import/iges/surface_128.cpp
  import/iges/surface_140.cpp
  import/iges/surface_143.cpp
  import/iges/surface_144.cpp
  import/iges/surface_190.cpp
  import/iges/surface_192.cpp
  import/iges/surface_194.cpp
  import/iges/surface_196.cpp
  import/iges/surface_198.cpp
  import/iges/tolerance_log.cpp
  import/iges/transform_124.cpp
  import/iges/trimmed_face.cpp
  import/iges/units.cpp
  import/import_error.cpp
  import/inspect/boundary_report.cpp
  import/inspect/edge_chords.cpp
  import/inspect/trimmed_area.cpp
  import/mesh/vertex_welder.cpp
  import/obj/read_obj.cpp
  import/read_model.cpp
  import/scan/lzf.cpp
  import/scan/read_pcd.cpp
  import/scan/read_ply.cpp
  import/scan/read_xyz.cpp
  import/scan/scan_builder.cpp
  import/stl/binary_stl.cpp
  import/stl/read_stl.cpp
  import/stl/text_stl.cpp
  import/threemf/model_part.cpp
  import/threemf/read_3mf.cpp
  import/threemf/xml_parser.cpp
  import/threemf/zip_archive.cpp
  import/trim/axis_map.cpp
  import/trim/fitted_path.cpp
  import/trim/loop_polygon.cpp
  import/trim/parameter_loop.cpp
  import/trim/surface_inverse.cpp
  import/trim/surface_topology.cpp
  import/trim/trimmed_patch.cpp
  import/trim/winding_loops.cpp
  nurbs/arc.cpp
  nurbs/bezier_chain.cpp
  nurbs/conic.cpp
  nurbs/degree_elevation.cpp
  nurbs/join.cpp
  nurbs/power_basis.cpp
  nurbs/restrict.cpp
  nurbs/reverse.cpp
  nurbs/revolution.cpp
  nurbs/ruled.cpp)

# STEP through OpenCASCADE where it is there: Debian's CMake package of it names targets that are missing, so its
# libraries are looked up one by one.
option(LAMINA_STEP "Read STEP files through OpenCASCADE where it is found" ON)
set(LAMINA_STEP_FOUND FALSE)
if(LAMINA_STEP)
  find_path(LAMINA_OPENCASCADE_INCLUDE STEPControl_Reader.hxx PATH_SUFFIXES opencascade)
  set(LAMINA_OPENCASCADE_LIBRARIES)
  set(LAMINA_STEP_FOUND TRUE)
  foreach(name TKSTEP TKXSBase TKShHealing TKTopAlgo TKGeomAlgo TKBRep TKGeomBase TKG3d TKG2d TKMath TKernel)
    find_library(LAMINA_OPENCASCADE_${name} ${name})
    mark_as_advanced(LAMINA_OPENCASCADE_${name})
    if(LAMINA_OPENCASCADE_${name} AND LAMINA_OPENCASCADE_INCLUDE)
      list(APPEND LAMINA_OPENCASCADE_LIBRARIES ${LAMINA_OPENCASCADE_${name}})
    else()
      set(LAMINA_STEP_FOUND FALSE)
    endif()
  endforeach()
endif()
add_library(lamina_opencascade INTERFACE)
if(LAMINA_STEP_FOUND)
  target_include_directories(lamina_opencascade SYSTEM INTERFACE ${LAMINA_OPENCASCADE_INCLUDE})
  target_link_libraries(lamina_opencascade INTERFACE ${LAMINA_OPENCASCADE_LIBRARIES})
  list(APPEND LAMINA_ENGINE_IMPORT_SOURCES import/step/read_step.cpp)
else()
  message(STATUS "OpenCASCADE not found: STEP files will not be read")
  list(APPEND LAMINA_ENGINE_IMPORT_SOURCES import/step/read_step_absent.cpp)
endif()
list(APPEND LAMINA_ENGINE_IMPORT_SOURCES import/step/recognise_step.cpp)

# What only the readers link: ZIP and XML for 3MF.
find_package(EXPAT REQUIRED)
pkg_check_modules(Zip REQUIRED IMPORTED_TARGET libzip)
set(LAMINA_ENGINE_IMPORT_LIBRARIES EXPAT::EXPAT PkgConfig::Zip lamina_opencascade)
