! The module of an installed tetlod: a cube of six tets with a linear field comes back exact.
program app
  use, intrinsic :: iso_fortran_env, only: int32, real64
  use tetlod
  implicit none
  real(real64), target :: xyz(3, 8), values(8)
  integer(int32), target :: tets(4, 6)
  real(real64), allocatable :: small(:)
  type(tetlod_context) :: lod
  integer :: v
  do v = 0, 7
    xyz(:, v + 1) = [ibits(v, 0, 1), ibits(v, 1, 1), ibits(v, 2, 1)]
  end do
  values = xyz(1, :) + 2 * xyz(2, :) - 3 * xyz(3, :)
  tets = 1 + reshape([0, 1, 3, 7, 0, 1, 5, 7, 0, 2, 3, 7, 0, 2, 6, 7, 0, 4, 5, 7, 0, 4, 6, 7], [4, 6])
  call lod%create()
  call lod%set_sigma(1d0)
  call lod%submit_points(xyz)
  call lod%submit_tets(tets)
  call lod%submit_scalars("linear", values)
  call lod%run()
  call lod%fetch_scalars(small)
  print '("Fortran: ", i0, " points")', size(small)
  if (size(small) /= 8 .or. abs(sum(small)) > 1d-12) error stop "not the cube"
  call lod%destroy()
end program
