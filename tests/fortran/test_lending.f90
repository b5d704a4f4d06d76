! What the module tetlod does with arrays that it is lent: it reads them in place, or says that it does not.
module lending_tests
  use, intrinsic :: iso_fortran_env, only: int32, int64, real32, real64
  use box_mesh, only: make_box
  use tetlod
  implicit none
  integer :: failures = 0
  integer(int64) :: packed
  real(real64), allocatable, target :: xyz(:, :), values(:)
  integer(int32), allocatable, target :: tets(:, :)

  type :: node
    integer(int32) :: id = 0
    real(real64) :: x(3) = 0, value = 0
  end type
  type :: element
    integer(int64) :: id = 0
    integer(int32) :: corners(4) = 0
  end type

contains

  subroutine expect(holds, what)
    logical, intent(in) :: holds
    character(len=*), intent(in) :: what
    if (holds) return
    failures = failures + 1
    print '("failed: ", a)', what
  end subroutine

  subroutine begin(lod)
    type(tetlod_context), intent(inout) :: lod
    call lod%create()
    call lod%set_rho(0.1)
    call lod%set_sigma(0.5)
    call lod%submit_points(xyz)
    call lod%submit_tets(tets)
    call lod%submit_scalars("bent", values)
  end subroutine

  ! The hash of the result's bytes.
  integer(int64) function finish(lod) result(hash)
    type(tetlod_context), intent(inout) :: lod
    type(tetlod_run_report) :: report
    character(len=200) :: message
    integer :: stat
    call lod%run(stat=stat, errmsg=message)
    call expect(stat == TETLOD_OK, "runs: "//message)
    call lod%fetch_report(report)
    hash = report%hash
    call lod%destroy()
  end function

  subroutine make_nodes(nodes)
    type(node), allocatable, intent(out) :: nodes(:)
    integer :: i
    allocate (nodes(size(values)))
    do i = 1, size(nodes)
      nodes(i)%x = xyz(:, i)
      nodes(i)%value = values(i)
    end do
  end subroutine

  subroutine test_components()
    type(node), allocatable, target :: nodes(:)
    complex(real64), allocatable, target :: wave(:)
    real(real64), pointer :: x(:), y(:), z(:), value(:)
    type(tetlod_context) :: lod
    call make_nodes(nodes)
    allocate (wave, source=cmplx(-values, values, real64))
    x => nodes(:)%x(1)
    y => nodes(:)%x(2)
    z => nodes(:)%x(3)
    value => nodes(:)%value
    call begin(lod)
    call lod%submit_points_xyz(x, y, z)
    call lod%submit_scalars("bent", value)
    call expect(finish(lod) == packed, "components through pointers give the bytes of packed arrays")
    value => wave(:)%im
    call begin(lod)
    call lod%submit_scalars("bent", value)
    call expect(finish(lod) == packed, "the imaginary part of a complex array")
    value => nodes(size(nodes):1:-1)%value
    nodes%value = nodes(size(nodes):1:-1)%value
    call begin(lod)
    call lod%submit_scalars("bent", value)
    call expect(finish(lod) == packed, "a component backwards")
  end subroutine

  ! Where the compiler passes them in place they are taken; a copy, or another component, is never.
  subroutine test_components_as_they_are()
    type(node), allocatable, target :: nodes(:)
    complex(real64), allocatable, target :: wave(:)
    type(element), target :: elements(2, 3)
    real(real32), allocatable, target :: single(:)
    type(tetlod_context) :: lod
    character(len=200) :: message
    integer :: stat
    call make_nodes(nodes)
    allocate (wave, source=cmplx(-values, values, real64))
    call begin(lod)
    call lod%submit_points_xyz(nodes%x(1), nodes%x(2), nodes%x(3), stat=stat, errmsg=message)
    call expect_in_place_or_refused(stat, message, "nodes%x")
    call lod%submit_scalars("bent", nodes%value, stat=stat, errmsg=message)
    call expect_in_place_or_refused(stat, message, "nodes%value")
    call expect(finish(lod) == packed, "what was lent before stays, or the component is read in place")
    call begin(lod)
    call lod%submit_scalars("bent", wave%im, stat=stat, errmsg=message)
    call expect_in_place_or_refused(stat, message, "wave%im")
    call lod%submit_steering("further", 0d0, nodes(:)%value, stat=stat, errmsg=message)
    call expect_in_place_or_refused(stat, message, "steering by nodes(:)%value")
    call expect(finish(lod) == packed, "the same for a part of a complex array")
    call begin(lod)
    call lod%submit_tets(elements%corners(1), stat=stat, errmsg=message)
    call expect_in_place_or_refused(stat, message, "elements%corners(1)")
    call lod%destroy()
    allocate (single(3))
    call lod%submit_scalars("bent", single, stat=stat, errmsg=message)
    call expect(stat == TETLOD_ERR_ARGUMENT .and. index(message, "create") > 0, "no context: "//message)
  end subroutine

  subroutine expect_in_place_or_refused(stat, message, what)
    integer, intent(in) :: stat
    character(len=*), intent(in) :: message, what
    logical :: refused
    refused = stat == TETLOD_ERR_ARGUMENT .and. index(message, "(:)%") > 0
    call expect(stat == TETLOD_OK .or. refused, what//": "//message)
  end subroutine

  subroutine test_bounds()
    real(real64), allocatable, target :: from_zero(:, :), values_from_zero(:)
    integer(int32), pointer :: shifted(:, :)
    type(tetlod_context) :: lod
    allocate (from_zero(0:2, 0:size(xyz, 2) - 1), values_from_zero(-7:size(values) - 8))
    from_zero = xyz
    values_from_zero = values
    shifted(-1:, 5:) => tets
    call begin(lod)
    call lod%submit_points(from_zero)
    call lod%submit_tets(shifted)
    call lod%submit_scalars("bent", values_from_zero)
    call expect(finish(lod) == packed, "arrays that begin at another index")
  end subroutine

  subroutine test_nothing()
    type(tetlod_context) :: lod
    real(real64), pointer :: nowhere(:), nothing(:, :)
    real(real64), allocatable, target :: empty(:)
    integer :: stat
    nullify (nowhere, nothing)
    allocate (empty(0))
    call begin(lod)
    call lod%submit_scalars("bent", nowhere, stat=stat)
    call expect(stat == TETLOD_ERR_ARGUMENT, "a null pointer")
    call lod%submit_field("nothing", TETLOD_POINT_FIELD, nothing, stat=stat)
    call expect(stat == TETLOD_ERR_ARGUMENT, "a null pointer to a table")
    call expect(finish(lod) == packed, "what was lent before stays")
    call begin(lod)
    call lod%submit_scalars("bent", empty, stat=stat)
    call expect(stat == TETLOD_OK, "an array without elements")
    call lod%submit_points(xyz(:, 2:1), stat=stat)
    call expect(stat == TETLOD_OK, "a section without elements")
    call lod%destroy()
  end subroutine

  ! A solver's procedures lend what they were given; the actual arguments here are targets, so their addresses last.
  subroutine test_dummies()
    type(tetlod_context) :: lod
    call begin(lod)
    call lend(lod, xyz, values)
    call lend_explicit(lod, size(tets, 2), tets)
    call expect(finish(lod) == packed, "dummy arguments with target")
    call begin(lod)
    call lod%submit_scalars("bent", pointer_to(values))
    call expect(finish(lod) == packed, "what a function with a pointer result gives")
  end subroutine

  subroutine lend(lod, points, field)
    type(tetlod_context), intent(inout) :: lod
    real(real64), intent(in), target :: points(:, :), field(:)
    call lod%submit_points(points)
    call lod%submit_scalars("bent", field)
  end subroutine

  subroutine lend_explicit(lod, m, corners)
    type(tetlod_context), intent(inout) :: lod
    integer, intent(in) :: m
    integer(int32), intent(in), target :: corners(4, m)
    call lod%submit_tets(corners)
  end subroutine

  function pointer_to(field) result(to)
    real(real64), intent(in), target :: field(:)
    real(real64), pointer :: to(:)
    to => field
  end function
end module

program test_lending
  use lending_tests
  implicit none
  type(tetlod_context) :: lod
  call make_box(8, xyz, tets)
  allocate (values, source=sin(4 * xyz(1, :)) + xyz(2, :) * xyz(3, :))
  call begin(lod)
  packed = finish(lod)
  call test_components()
  call test_components_as_they_are()
  call test_bounds()
  call test_nothing()
  call test_dummies()
  if (failures > 0) error stop "the module tetlod does not read in place what it is lent"
  print '("ok")'
end program
