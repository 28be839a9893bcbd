! SPDX-License-Identifier: GPL-3.0-or-later
! A program in Fortran that asks for the gap of two ellipsoids.
program contact
  use, intrinsic :: iso_c_binding
  use tangency
  implicit none
  real(c_double) :: a(10), b(10)
  real(c_double), target :: gap(1)
  type(tangency_contact_columns) :: answers
  integer(c_int) :: code

  a = [real(c_double) :: 0, 0, 0, 1, 2, 3, 1, 0, 0, 0]
  b = [real(c_double) :: 0, 0, 7, 3, 2, 1, 1, 0, 0, 0]
  gap = 0
  answers%size = c_sizeof(answers)
  answers%gap = c_loc(gap)
  code = tangency_contacts_of_rows(a, 80_c_ptrdiff_t, b, 80_c_ptrdiff_t, 1_c_size_t, answers=answers, threads=1_c_int)
  print *, 'gap', gap(1)
  if (code /= TANGENCY_OK .or. gap(1) /= 3) stop 1
end program contact
