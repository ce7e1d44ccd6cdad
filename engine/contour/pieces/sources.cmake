# Few exact pieces from a chain of contour nodes, and balanced chords from the pieces.
set(LAMINA_ENGINE_PIECES_SOURCES
  contour/pieces/arc_length.cpp
  contour/pieces/balanced_chords.cpp
  contour/pieces/banded_cholesky.cpp
  contour/pieces/curve_piece.cpp
  contour/pieces/fit_pieces.cpp
  contour/pieces/knot_density.cpp
  contour/pieces/piece_curve.cpp
  contour/pieces/runs.cpp
  contour/pieces/smooth_chain.cpp
  contour/pieces/spline_fit.cpp
  contour/pieces/spline_system.cpp)
