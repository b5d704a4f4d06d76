! The README's subroutine in Fortran on a mesh of ours: a cube of cells of six tets each.
program main
  use, intrinsic :: iso_fortran_env, only: int32, real64
  implicit none
  interface
    subroutine simplify(xyz, tets, density, xyz_small, tets_small, density_small)
      import :: int32, real64
      real(real64), intent(in), target :: xyz(:, :), density(:)
      integer(int32), intent(in), target :: tets(:, :)
      real(real64), allocatable, intent(out) :: xyz_small(:, :), density_small(:)
      integer(int32), allocatable, intent(out) :: tets_small(:, :)
    end subroutine
  end interface
  integer, parameter :: n = 8, row = n + 1
  integer, parameter :: order(3, 6) = reshape([1, 2, 3, 1, 3, 2, 2, 1, 3, 2, 3, 1, 3, 1, 2, 3, 2, 1], [3, 6])
  real(real64), target :: xyz(3, row**3), density(row**3)
  integer(int32), target :: tets(4, 6 * n**3)
  real(real64), allocatable :: xyz_small(:, :), density_small(:)
  integer(int32), allocatable :: tets_small(:, :)
  integer :: v, cell, path, step, at(3), tet
  do v = 0, row**3 - 1
    xyz(:, v + 1) = [mod(v, row), mod(v / row, row), v / row**2]
  end do
  density = xyz(1, :) + 2 * xyz(2, :) - 3 * xyz(3, :)
  tet = 0
  do cell = 0, n**3 - 1
    do path = 1, 6
      at = [mod(cell, n), mod(cell / n, n), cell / n**2]
      tet = tet + 1
      tets(1, tet) = node(at)
      do step = 1, 3
        at(order(step, path)) = at(order(step, path)) + 1
        tets(step + 1, tet) = node(at)
      end do
    end do
  end do
  call simplify(xyz, tets, density, xyz_small, tets_small, density_small)
  print '(i0, " of ", i0, " tets")', size(tets_small, 2), size(tets, 2)
  if (size(xyz_small, 2) /= size(density_small)) error stop "a value is missing"
contains
  integer function node(at)
    integer, intent(in) :: at(3)
    node = 1 + at(1) + row * (at(2) + row * at(3))
  end function
end program
