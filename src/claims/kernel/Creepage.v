(* What every theorem rests on: functions that Coq's library does not have, and the tactic that closes them. *)

Require Export Reals.
Require Import Lra Nsatz Ratan.
Open Scope R_scope.

Definition cot (x : R) : R := cos x / sin x.

Lemma sin_atan_tan : forall u, sin (atan u) = u * cos (atan u).
Proof. intro u. rewrite sin_atan, cos_atan. unfold Rdiv. ring. Qed.

Lemma cos_atan_nonzero : forall u, cos (atan u) <> 0.
Proof.
  intro u. rewrite cos_atan. unfold Rdiv. rewrite Rmult_1_l.
  apply Rinv_neq_0_compat, Rgt_not_eq, sqrt_lt_R0. pose proof (Rle_0_sqr u). lra.
Qed.

Lemma sin_square : forall x, sin x ^ 2 = 1 - cos x ^ 2.
Proof. intro x. pose proof (sin2_cos2 x) as H. unfold Rsqr in H. simpl. lra. Qed.

Lemma cos_atan_square : forall u, (1 + u ^ 2) * cos (atan u) ^ 2 = 1.
Proof.
  intro u. pose proof (sin_square (atan u)) as H. rewrite sin_atan_tan in H.
  replace ((1 + u ^ 2) * cos (atan u) ^ 2) with ((u * cos (atan u)) ^ 2 + cos (atan u) ^ 2) by ring.
  rewrite H. ring.
Qed.

Global Hint Rewrite sin_plus cos_plus sin_minus cos_minus sin_neg cos_neg sin_2a cos_2a sin_atan_tan sin_0 cos_0 : angles.

(* Sines and cosines become numbers of which one knows that their squares add up to one. *)
Ltac name_angle x :=
  let s := fresh "s" in let c := fresh "c" in let square := fresh "square" in
  pose proof (sin_square x) as square;
  try (let nonzero := fresh "nonzero" in
       lazymatch x with atan ?u => pose proof (cos_atan_nonzero u); pose proof (cos_atan_square u) end);
  set (s := sin x) in *; set (c := cos x) in *; clearbody s c.

Ltac name_angles :=
  repeat match goal with
  | |- context [sin ?x] => name_angle x
  | |- context [cos ?x] => name_angle x
  | H : context [sin ?x] |- _ => name_angle x
  | H : context [cos ?x] |- _ => name_angle x
  end.

Lemma factor_left : forall x y, x * y <> 0 -> x <> 0.
Proof. intros x y H E. apply H. rewrite E. ring. Qed.

Lemma factor_right : forall x y, x * y <> 0 -> y <> 0.
Proof. intros x y H E. apply H. rewrite E. ring. Qed.

Lemma base_of_power : forall x n, x ^ S n <> 0 -> x <> 0.
Proof. intros x n H E. apply H. rewrite E. simpl. ring. Qed.

Lemma opposite : forall x, - x <> 0 -> x <> 0.
Proof. intros x H E. apply H. rewrite E. ring. Qed.

(* A product that is not zero has no factor that is. *)
Ltac factors :=
  repeat match goal with
  | H : ?x * ?y <> 0 |- _ => pose proof (factor_left x y H); pose proof (factor_right x y H); clear H
  | H : ?x / ?y <> 0 |- _ => unfold Rdiv in H
  | H : ?x ^ S ?n <> 0 |- _ => apply base_of_power in H
  | H : - ?x <> 0 |- _ => apply opposite in H
  | H : / ?x <> 0 |- _ => clear H
  end.

(* Membership in the ideal of the hypotheses; powers are written out, for the tactic takes them for unknowns. *)
Ltac ideal := cbn [Rpow_def.pow] in *; nsatz.

(* X <> 0 because a hypothesis says so, or because X = 0 would make vanish what is not zero. *)
Ltac nonzero :=
  repeat match goal with |- _ /\ _ => split end;
  first
    [ assumption
    | lra
    | let H := fresh "H" in intro H;
      first
        [ match goal with K : ?y <> 0 |- False => solve [ apply K; field_simplify_eq; [ lra | clear H; nonzero .. ] ] end
        | match goal with K : ?y <> 0, A : ?a <> 0 |- False =>
            solve [ apply K; field_simplify_eq; [ apply (Rmult_eq_reg_l a); [ lra | exact A ] | clear H; nonzero .. ] ] end
        | match goal with K : ?y <> 0 |- False => solve [ apply K; field_simplify_eq; [ ideal | clear H; nonzero .. ] ] end ] ].

Ltac squares_field :=
  lazymatch goal with
  | A : ?a ^ 2 = 1 - ?a' ^ 2, B : ?b ^ 2 = 1 - ?b' ^ 2, C : ?c ^ 2 = 1 - ?c' ^ 2, D : ?d ^ 2 = 1 - ?d' ^ 2, E : ?e ^ 2 = 1 - ?e' ^ 2 |- _ => field [A B C D E]
  | A : ?a ^ 2 = 1 - ?a' ^ 2, B : ?b ^ 2 = 1 - ?b' ^ 2, C : ?c ^ 2 = 1 - ?c' ^ 2, D : ?d ^ 2 = 1 - ?d' ^ 2 |- _ => field [A B C D]
  | A : ?a ^ 2 = 1 - ?a' ^ 2, B : ?b ^ 2 = 1 - ?b' ^ 2, C : ?c ^ 2 = 1 - ?c' ^ 2 |- _ => field [A B C]
  | A : ?a ^ 2 = 1 - ?a' ^ 2, B : ?b ^ 2 = 1 - ?b' ^ 2 |- _ => field [A B]
  | A : ?a ^ 2 = 1 - ?a' ^ 2 |- _ => field [A]
  | _ => field
  end.

Ltac creepage :=
  intros; subst; unfold tan, cot in *; autorewrite with angles in *; name_angles; factors;
  first [ solve [ squares_field; nonzero ] | field_simplify_eq; [ solve [ ideal ] | nonzero .. ] ].
